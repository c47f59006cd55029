#include "analysis/blind/intervals.hpp"

#include <cmath>
#include <initializer_list>
#include <limits>

namespace drift::blind {
namespace {

/// Continued fraction of the incomplete beta function, converges for x < (a + 1)/(a + b + 2)
/// (Abramowitz and Stegun 26.5.8).
double beta_fraction(double a, double b, double x) {
  constexpr double tiny = 1e-300;
  double c = 1.0, d = 1.0 - (a + b) * x / (a + 1.0);
  d = 1.0 / (std::abs(d) < tiny ? tiny : d);
  double h = d;
  for (int m = 1; m < 1000; ++m) {
    for (const bool odd : {false, true}) {
      const double k = odd ? -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0))
                           : m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
      d = 1.0 + k * d;
      d = 1.0 / (std::abs(d) < tiny ? tiny : d);
      c = 1.0 + k / c;
      if (std::abs(c) < tiny) c = tiny;
      h *= c * d;
    }
    if (std::abs(c * d - 1.0) < 1e-15) break;
  }
  return h;
}

/// x with I_x(a, b) = p, by bisection to rounding.
double beta_quantile(double p, double a, double b) {
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (incomplete_beta(a, b, middle) < p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

double Proportion::share() const {
  return n > 0 ? static_cast<double>(k) / static_cast<double>(n)
               : std::numeric_limits<double>::quiet_NaN();
}

double incomplete_beta(double a, double b, double x) {
  if (x <= 0.0) return 0.0;
  if (x >= 1.0) return 1.0;
  const double front = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) +
                                a * std::log(x) + b * std::log1p(-x));
  return x < (a + 1.0) / (a + b + 2.0) ? front * beta_fraction(a, b, x) / a
                                       : 1.0 - front * beta_fraction(b, a, 1.0 - x) / b;
}

Proportion proportion(std::size_t k, std::size_t n, double confidence) {
  const double tail = 0.5 * (1.0 - confidence), kd = static_cast<double>(k),
               nd = static_cast<double>(n);
  Proportion p{k, n};
  if (n == 0) return p;
  if (k > 0) p.low = beta_quantile(tail, kd, nd - kd + 1.0);
  if (k < n) p.high = beta_quantile(1.0 - tail, kd + 1.0, nd - kd);
  return p;
}

}  // namespace drift::blind
