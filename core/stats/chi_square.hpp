#pragma once

#include <cmath>
#include <limits>
#include <numbers>

namespace drift::stats {

/// Natural log of P(chi-square of `dof` degrees > T), accurate far into the tail.
/// Upper incomplete gamma function: series below its mean, continued fraction (Lentz) above.
inline double log_tail(double T, double dof) {
  if (!(T > 0.0)) return 0.0;
  const double a = 0.5 * dof, x = 0.5 * T;
  const double front = a * std::log(x) - x - std::lgamma(a);
  if (x < a + 1.0) {
    double term = 1.0 / a, sum = term;
    for (int n = 1; n < 10000 && term > 1e-17 * sum; ++n) sum += term *= x / (a + n);
    return std::log1p(-std::exp(front) * sum);
  }
  constexpr double tiny = 1e-300;
  double b = x + 1.0 - a, c = 1.0 / tiny, d = 1.0 / b, h = d;
  for (int n = 1; n < 10000; ++n) {
    const double an = -n * (n - a);
    b += 2.0;
    d = an * d + b;
    if (std::abs(d) < tiny) d = tiny;
    c = b + an / c;
    if (std::abs(c) < tiny) c = tiny;
    d = 1.0 / d;
    h *= d * c;
    if (std::abs(d * c - 1.0) < 1e-15) break;
  }
  return front + std::log(h);
}

/// T of `dof` degrees as evidence on one scale: minus the log of its tail probability.
inline double strength(double T, int dof) {
  return dof > 0 ? -log_tail(T, dof) : 0.0;
}

/// The T of `dof` degrees that has this strength; by bisection.
inline double quantile_of_strength(double s, int dof) {
  double low = 0.0, high = 2.0 * s + 20.0 * dof + 20.0;
  for (int i = 0; i < 200 && high - low > 1e-10 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (strength(middle, dof) < s ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace drift::stats
