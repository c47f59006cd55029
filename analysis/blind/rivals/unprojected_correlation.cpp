#include <cmath>

#include "analysis/blind/rivals/rival.hpp"
#include "core/stats/chi_square.hpp"

namespace drift::blind {

RivalAnswer unprojected_correlation(const RivalTest& test, double alpha) {
  const inference::Projector& p = *test.examined.projector;
  const VecX residual = p.clean_residual();
  double largest = 0.0;
  std::size_t best = 0;
  for (const RivalTest::Column& c : test.columns) {
    const VecX s = p.extra().col(c.column);
    const double product = s.dot(residual), T = product * product / s.squaredNorm();
    if (!(T > largest)) continue;
    largest = T;
    best = c.candidate;
  }
  RivalAnswer out;
  out.alarm =
      !test.columns.empty() &&
      stats::log_tail(largest, 1) < std::log(alpha / static_cast<double>(test.columns.size()));
  if (out.alarm) out.named = {best};
  return out;
}

}  // namespace drift::blind
