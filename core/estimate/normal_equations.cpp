#include "core/estimate/normal_equations.hpp"

#include <Eigen/Cholesky>
#include <limits>

#include "core/base/decompose.hpp"

namespace drift {

NormalEquations::NormalEquations(const std::vector<ChainEquations>& rows,
                                 const std::vector<Vec3>& psi, const VecX& x)
    : psi_(psi), x_(x) {
  for (const ChainEquations& c : rows) {
    MatX& N = chains_.emplace_back(MatX::Zero(c.rows.cols(), c.rows.cols()));
    if (c.rows.rows() > 0)  // Eigen divides by it
      N.selfadjointView<Eigen::Lower>().rankUpdate(c.rows.transpose());
  }
}

bool NormalEquations::good_to(double relative) const {
  // A sum of m products is off by at most m eps of its size; elimination adds as much again.
  double largest = 0.0;
  for (const MatX& N : chains_) {
    if (!N.diagonal().allFinite()) return false;
    largest += N.diagonal().head(N.cols() - 1).maxCoeff();
  }
  return 2.0 * std::numeric_limits<double>::epsilon() * largest < relative;
}

BatchEquations::Step NormalEquations::solve(double mu, std::optional<Eigen::Index> held,
                                            const MatX& second) const {
  const Eigen::Index n = x_.size();
  // S over [x | r], what is left of a chain when its attitude is eliminated: L L^T is that of the
  // attitude with its prior and damping, T = L^-1 [its columns].
  MatX S = MatX::Zero(n + 1, n + 1);
  std::vector<Eigen::LLT<Mat3>> of_attitude;
  std::vector<Mat3X> T;
  for (std::size_t c = 0; c < chains_.size(); ++c) {
    const MatX& N = chains_[c];
    const Mat3 A = N.topLeftCorner<3, 3>().selfadjointView<Eigen::Lower>();
    of_attitude.emplace_back(A + (1.0 + mu) * Mat3::Identity());
    Mat3X with_attitude = N.block(3, 0, n + 1, 3).transpose();
    with_attitude.col(n) -= psi_[c];
    T.push_back(of_attitude.back().matrixL().solve(with_attitude));
    S.triangularView<Eigen::Lower>() += N.bottomRightCorner(n + 1, n + 1);
    S.selfadjointView<Eigen::Lower>().rankUpdate(T.back().transpose(), -1.0);
  }
  MatX on_x = S.topLeftCorner(n, n);
  on_x.diagonal().array() += 1.0 + mu;
  VecX right = S.row(n).head(n).transpose() - x_;
  if (held) right[*held] = 0.0;
  const auto solved = [&](MatX A) {
    if (held) {
      A.row(*held).setZero();
      A.col(*held).setZero();
      A(*held, *held) = 1.0;
    }
    return Cholesky(A);
  };
  BatchEquations::Step step;
  if (second.size() > 0)
    if (const Cholesky all = solved(on_x + second); all.definite()) step.dx = all.solve(right);
  if (step.dx.size() == 0) step.dx = solved(std::move(on_x)).solve(right);
  step.slope = right.dot(step.dx);
  for (const Mat3X& t : T) step.slope += t.col(n).squaredNorm();
  for (std::size_t c = 0; c < chains_.size(); ++c)
    step.dpsi.push_back(of_attitude[c].matrixU().solve(T[c].col(n) - T[c].leftCols(n) * step.dx));
  return step;
}

}  // namespace drift
