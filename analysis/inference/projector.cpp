#include "analysis/inference/projector.hpp"

#include <Eigen/Cholesky>
#include <cmath>

namespace drift::inference {

Projector::Projector(const LinearProblem& problem, const NoiseModel& noise) {
  whitener_.emplace(problem, noise);
  const Eigen::Index n = problem.theta.cols(), K = problem.extra.cols();
  MatX all(problem.rows(), n + K + 1);
  all << problem.theta, problem.extra, problem.r0;
  all = whitener_->apply(all);
  theta_ = all.leftCols(n);
  extra_ = all.middleCols(n, K);
  r0_ = all.rightCols<1>();
  project(whitener_->log_det());
}

Projector::Projector(MatX theta, MatX extra, VecX r0, double log_det)
    : theta_(std::move(theta)), extra_(std::move(extra)), r0_(std::move(r0)) {
  project(log_det);
}

void Projector::project(double log_det) {
  const Eigen::Index n = theta_.cols(), K = extra_.cols();
  MatX A = MatX::Identity(n, n);
  A.selfadjointView<Eigen::Lower>().rankUpdate(theta_.transpose());
  L_ = Eigen::LLT<MatX, Eigen::Lower>(A).matrixL();
  MatX right(theta_.rows(), K + 1);
  right << extra_, r0_;
  half_ = theta_.transpose() * right;
  L_.triangularView<Eigen::Lower>().solveInPlace(half_);

  MatX M = MatX::Zero(K + 1, K + 1);
  M.selfadjointView<Eigen::Lower>().rankUpdate(right.transpose());
  projected_.raw = M.diagonal().head(K);
  M.selfadjointView<Eigen::Lower>().rankUpdate(half_.transpose(), -1.0);
  M.triangularView<Eigen::StrictlyUpper>() = M.transpose();
  projected_.C = M.topLeftCorner(K, K);
  projected_.g = M.col(K).head(K);
  projected_.chi2 = M(K, K);
  projected_.rows = theta_.rows();
  projected_.log_det = log_det + 2.0 * L_.diagonal().array().log().sum();
}

Projector::Scan Projector::scan(const MatX& columns, Eigen::Index first) const {
  const MatX white = whitener_ ? whitener_->apply(columns, first) : columns;
  const Eigen::Index L = white.cols(), K = extra_.cols(), count = white.rows();
  MatX h = theta_.middleRows(first, count).transpose() * white;
  L_.triangularView<Eigen::Lower>().solveInPlace(h);
  Scan out;
  MatX M = MatX::Zero(L, L);
  M.selfadjointView<Eigen::Lower>().rankUpdate(white.transpose());
  out.raw = M.diagonal();
  M.selfadjointView<Eigen::Lower>().rankUpdate(h.transpose(), -1.0);
  out.C = M.selfadjointView<Eigen::Lower>();
  out.cross =
      white.transpose() * extra_.middleRows(first, count) - h.transpose() * half_.leftCols(K);
  out.g = white.transpose() * r0_.segment(first, count) - h.transpose() * half_.col(K);
  return out;
}

VecX Projector::clean_residual() const {
  return r0_ - theta_ * L_.transpose().triangularView<Eigen::Upper>().solve(half_.rightCols<1>());
}

MatX Projector::clean_extra(const std::vector<int>& columns) const {
  MatX out(theta_.rows(), columns.size());
  for (std::size_t k = 0; k < columns.size(); ++k)
    out.col(k) =
        extra_.col(columns[k]) -
        theta_ * L_.transpose().triangularView<Eigen::Upper>().solve(half_.col(columns[k]));
  return out;
}

Projector::Fit Projector::fit(const std::vector<int>& with) const {
  const Eigen::Index n = theta_.cols(), m = with.size();
  MatX T(theta_.rows(), n + m);
  T.leftCols(n) = theta_;
  for (Eigen::Index k = 0; k < m; ++k) T.col(n + k) = extra_.col(with[k]);
  MatX A = T.transpose() * T;
  A.topLeftCorner(n, n) += MatX::Identity(n, n);
  const Eigen::LDLT<MatX> ldlt(A);
  return {ldlt.solve(T.transpose() * r0_), ldlt.solve(MatX::Identity(n + m, n + m))};
}

}  // namespace drift::inference
