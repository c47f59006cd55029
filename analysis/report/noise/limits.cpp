#include "analysis/report/noise/limits.hpp"

#include <algorithm>
#include <cmath>

namespace drift::report {

double limit_of(const stats::AllanFit& fit, stats::AllanNoise noise) {
  double limit = fit[noise].upper;
  for (const stats::AllanPoint& p : fit.points) {
    const double slope = stats::allan_slopes(p.tau)[static_cast<Eigen::Index>(noise)],
                 bound = p.high / std::sqrt(slope);
    if (bound > 0.0 && bound < limit) limit = bound;  // not of an interval without an end
  }
  return std::isfinite(limit) ? limit : 0.0;
}

}  // namespace drift::report
