#include "core/stats/normal.hpp"

#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <numbers>

namespace drift::stats {

double normal_distribution(double z) {
  return 0.5 * std::erfc(-z / std::numbers::sqrt2);
}

double normal_quantile(double p) {
  return -std::numbers::sqrt2 * boost::math::erfc_inv(2.0 * p);
}

double normal_half_width(double confidence) {
  return normal_quantile(0.5 + 0.5 * confidence);
}

}  // namespace drift::stats
