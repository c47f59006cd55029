#pragma once

#include <cstddef>

namespace drift::blind {

/// A share k of n with its 95 % interval.
struct Proportion {
  std::size_t k = 0, n = 0;
  double share() const;          ///< NaN if n = 0
  double low = 0.0, high = 1.0;  ///< Clopper and Pearson 1934
};

/// Exact (Clopper-Pearson) interval: covers at least `confidence` whatever the true share.
Proportion proportion(std::size_t k, std::size_t n, double confidence = 0.95);

/// Regularised incomplete beta function I_x(a, b), by continued fraction (Lentz).
double incomplete_beta(double a, double b, double x);

}  // namespace drift::blind
