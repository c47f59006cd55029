#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

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
  double low(double z = 1.959963984540054) const {
    return hits > 0 ? centre(z) - half_width(z) : 0.0;
  }
  double high(double z = 1.959963984540054) const {
    return hits < of ? centre(z) + half_width(z) : 1.0;
  }
  double half_width(double z = 1.959963984540054) const {
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

}  // namespace drift::stats
