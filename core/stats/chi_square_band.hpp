#pragma once

#include <algorithm>
#include <cmath>

#include "core/stats/normal.hpp"

namespace drift::stats {

/// An interval.
struct Band {
  double low = 0.0, high = 0.0;
  bool holds(double value) const { return value >= low && value <= high; }
};

/// Where chi-square divided by its degrees of freedom lies with 95 % probability.
///
/// Wilson and Hilferty: (chi2/m)^(1/3) is normal with mean 1 - 2/(9m) and variance 2/(9m). The
/// bounds are off by less than 0.01 for m >= 6 and 0.1 for m = 1.
inline Band chi_square_band(double dof) {
  constexpr double z = half_width_95;
  const double v = 2.0 / (9.0 * dof), s = std::sqrt(v);
  const auto cube = [](double x) { return x * x * x; };
  return {std::max(0.0, cube(1.0 - v - z * s)), cube(1.0 - v + z * s)};
}

/// The chance that chi-square over its degrees of freedom is as far from what is usual, on either
/// side; by the same approximation, and so below 0.05 just outside chi_square_band().
inline double chi_square_chance(double per_dof, double dof) {
  const double v = 2.0 / (9.0 * dof);
  return 2.0 * normal_distribution(-std::abs(std::cbrt(per_dof) - (1.0 - v)) / std::sqrt(v));
}

/// That of a fit: one that leaves less than is usual is no misfit.
inline double misfit_chance(double per_dof, double dof) {
  return per_dof > 1.0 ? chi_square_chance(per_dof, dof) : 1.0;
}

}  // namespace drift::stats
