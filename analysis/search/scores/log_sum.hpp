#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace drift::search {

constexpr double never = -std::numeric_limits<double>::infinity();  ///< log of no probability

/// log(exp(a) + exp(b))
inline double log_sum(double a, double b) {
  const double top = std::max(a, b);
  return top == never ? never : top + std::log(std::exp(a - top) + std::exp(b - top));
}

}  // namespace drift::search
