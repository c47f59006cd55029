#include "core/estimate/batch_equations.hpp"

#include <cmath>

#include "core/estimate/triangle.hpp"

namespace drift {

BatchEquations::Reduced BatchEquations::reduced(double mu) const {
  const Eigen::Index n = x.size();
  Reduced out{MatX::Zero(n + 1, n + 1), {}};
  for (std::size_t c = 0; c < chains.size(); ++c) {
    MatX extra = MatX::Zero(mu > 0.0 ? 6 : 3, 3 + n + 1);
    extra.topLeftCorner<3, 3>().setIdentity();
    extra.block<3, 1>(0, 3 + n) = -psi[c];
    if (mu > 0.0) extra.block<3, 3>(3, 0) = std::sqrt(mu) * Mat3::Identity();
    const MatX R = triangle(stacked(chains[c], extra));
    out.tops.push_back(R.topRows<3>());
    out.triangle = triangle(stacked(out.triangle, R.bottomRightCorner(n + 1, n + 1)));
  }
  return out;
}

BatchEquations::Step BatchEquations::solve(double mu, std::optional<Eigen::Index> held) const {
  const Eigen::Index n = x.size();
  auto [data, tops] = reduced(mu);
  MatX extra = MatX::Zero(2 * n, n + 1);
  extra.topLeftCorner(n, n).setIdentity();
  extra.topRightCorner(n, 1) = -x;
  extra.block(n, 0, n, n) = std::sqrt(mu) * MatX::Identity(n, n);
  if (held) {
    data.col(*held).setZero();
    extra(*held, n) = 0.0;
  }
  const MatX R = triangle(stacked(data, extra));
  Step step;
  step.slope = R.topRightCorner(n, 1).squaredNorm();
  step.dx = R.topLeftCorner(n, n).triangularView<Eigen::Upper>().solve(R.topRightCorner(n, 1));
  for (const MatX& top : tops) {
    step.slope += top.rightCols<1>().squaredNorm();
    const Vec3 right = top.rightCols<1>() - top.middleCols(3, n) * step.dx;
    step.dpsi.push_back(top.leftCols<3>().triangularView<Eigen::Upper>().solve(right));
  }
  return step;
}

}  // namespace drift
