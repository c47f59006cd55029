#include "core/stats/chi_square.hpp"

#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <numbers>

#include "core/stats/normal.hpp"

namespace drift::stats {
namespace {

/// In double throughout: a search takes millions of these.
using Plain = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

}  // namespace

double log_tail(double T, double dof) {
  constexpr double representable = 1e-290;
  if (!(T > 0.0)) return 0.0;
  const double a = 0.5 * dof, x = 0.5 * T;
  if (x < a + 1.0) return std::log1p(-boost::math::gamma_p(a, x, Plain()));
  const double q = boost::math::gamma_q(a, x, Plain());
  return q > representable ? std::log(q) : log_far_tail(T, dof);
}

double log_far_tail(double T, double dof) {
  constexpr int terms = 100;  // one is enough where a is small; none is lost where it is large
  const double a = 0.5 * dof, x = 0.5 * T;
  double fraction = x + 2 * terms + 1 - a;
  for (int n = terms; n > 0; --n) fraction = x + (2 * n - 1) - a - n * (n - a) / fraction;
  return a * std::log(x) - x - std::lgamma(a) - std::log(fraction);
}

double deviate(double T, double dof) {
  constexpr double nearly_sure = -1e-15, representable = -690.0;
  const double log_p = log_tail(T, dof);
  if (log_p > nearly_sure) return normal_quantile(-nearly_sure);
  if (log_p > representable) return -normal_quantile(std::exp(log_p));
  // P(z) = exp(-z^2 / 2) / (z sqrt(2 pi)) (1 - 1 / z^2 ...): its log holds to 1 / z^2 < 1e-3.
  double z = std::sqrt(-2.0 * log_p);
  for (int i = 0; i < 4; ++i)
    z = std::sqrt(-2.0 * log_p - std::log(2.0 * std::numbers::pi * z * z));
  return z;
}

double quantile_of_strength(double s, int dof) {
  double low = 0.0, high = 2.0 * s + 20.0 * dof + 20.0;
  for (int i = 0; i < 200 && high - low > 1e-10 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (strength(middle, dof) < s ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace drift::stats
