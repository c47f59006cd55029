#include "core/stats/proportion.hpp"

#include <boost/math/special_functions/beta.hpp>

namespace drift::stats {

Proportion proportion(std::size_t k, std::size_t n, double confidence) {
  const double tail = 0.5 * (1.0 - confidence);
  const auto hits = static_cast<double>(k), misses = static_cast<double>(n - k);
  Proportion p{k, n};
  if (k > 0) p.low = boost::math::ibeta_inv(hits, misses + 1.0, tail);
  if (k < n) p.high = boost::math::ibeta_inv(hits + 1.0, misses, 1.0 - tail);
  return p;
}

double binomial_tail(std::size_t k, std::size_t n, double p) {
  if (k == 0) return 1.0;
  if (k > n || !(p > 0.0)) return 0.0;
  if (p >= 1.0) return 1.0;
  return boost::math::ibeta(static_cast<double>(k), static_cast<double>(n - k) + 1.0, p);
}

}  // namespace drift::stats
