#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/stats/normal.hpp"

namespace drift::stats {

/// A share of runs, with its Wilson score interval (Wilson 1927): right to a percent or so of
/// coverage from a few dozen runs on, and never outside 0..1, even where nothing or everything hit.
struct Rate {
  std::uint64_t hits = 0, of = 0;

  void count(bool hit) {
    hits += hit ? 1 : 0;
    ++of;
  }
  double value() const {
    return of > 0 ? static_cast<double>(hits) / static_cast<double>(of)
                  : std::numeric_limits<double>::quiet_NaN();
  }
  /// Bounds for a two-sided interval of z standard deviations; 0..1 without runs.
  /// Exactly 0 where nothing hit and 1 where everything did.
  double low(double z = half_width_95) const { return hits > 0 ? centre(z) - half_width(z) : 0.0; }
  double high(double z = half_width_95) const {
    return hits < of ? centre(z) + half_width(z) : 1.0;
  }
  double half_width(double z = half_width_95) const {
    if (of == 0) return 0.5;
    const double n = static_cast<double>(of), p = value();
    return z / (1.0 + z * z / n) * std::sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n));
  }

 private:
  double centre(double z) const {
    const double n = static_cast<double>(of);
    return (value() + z * z / (2.0 * n)) / (1.0 + z * z / n);
  }
};

/// A share k of n with an interval that covers at least its confidence whatever the true share is
/// (Clopper and Pearson 1934): wider than a Rate's, for what is judged by few trials.
struct Proportion {
  std::size_t k = 0, n = 0;
  double low = 0.0, high = 1.0;
  double share() const { return Rate{k, n}.value(); }
};
Proportion proportion(std::size_t k, std::size_t n, double confidence = 0.95);

/// P(X >= k), X binomial of n trials with probability p each.
double binomial_tail(std::size_t k, std::size_t n, double p);

}  // namespace drift::stats
