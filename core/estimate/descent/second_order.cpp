#include "core/estimate/descent/second_order.hpp"

#include <algorithm>
#include <cmath>

namespace drift {

void SecondOrder::learn(const Evaluation& from, const Evaluation& to) {
  const Eigen::Index n = from.x.size();
  const bool alike = std::ranges::equal(
      from.rows, to.rows, {}, [](const ChainEquations& c) { return c.rows.rows(); },
      [](const ChainEquations& c) { return c.rows.rows(); });
  if (!alike || !std::isfinite(to.cost)) return forget();
  VecX bent = VecX::Zero(n);
  for (std::size_t c = 0; c < to.rows.size(); ++c) {
    const MatX &a = from.rows[c].rows, &b = to.rows[c].rows;
    const auto r = b.rightCols<1>();
    bent.noalias() += a.middleCols(3, n).transpose() * r;
    bent.noalias() -= b.middleCols(3, n).transpose() * r;
  }
  const VecX step = to.x - from.x;
  if (S_.size() == 0) S_ = MatX::Zero(n, n);
  const VecX missing = bent - S_ * step;
  const double along = missing.dot(step);
  constexpr double told_from_rounding = 1e-8;
  if (std::abs(along) <= told_from_rounding * missing.norm() * step.norm()) return;
  S_.noalias() += missing * (missing / along).transpose();
}

}  // namespace drift
