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

bool normal_says(double mean, double sigma, double low, double high) {
  constexpr double tail = 0.025;
  const auto says = [](double beyond) { return 2.0 * beyond >= tail && beyond <= 2.0 * tail; };
  return says(normal_distribution((low - mean) / sigma)) &&
         says(normal_distribution((mean - high) / sigma));
}

}  // namespace drift::stats
