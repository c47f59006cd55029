#pragma once

namespace drift::stats {

/// An interval.
struct Band {
  double low = 0.0, high = 0.0;
  bool holds(double value) const { return value >= low && value <= high; }
};

inline constexpr double band_tail = 0.025;  ///< beyond either end of chi_square_band()

/// Where chi-square divided by its degrees of freedom lies with 95 % probability, 2.5 % on either
/// side (Boost.Math). NaN without degrees.
Band chi_square_band(double dof);

/// The chance that chi-square over its degrees of freedom is as far from what is usual, on either
/// side: below 0.05 outside chi_square_band().
double chi_square_chance(double per_dof, double dof);

/// That of a fit: one that leaves less than is usual is no misfit.
inline double misfit_chance(double per_dof, double dof) {
  return per_dof > 1.0 ? chi_square_chance(per_dof, dof) : 1.0;
}

}  // namespace drift::stats
