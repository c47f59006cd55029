#pragma once

namespace drift::stats {

/// Standard normal distribution function and its inverse (Boost.Math), both good to a few units in
/// the last place. normal_quantile: 0 < p < 1.
double normal_distribution(double z);
double normal_quantile(double p);

/// Half width of a two-sided interval of this confidence, in standard deviations.
double normal_half_width(double confidence);
inline constexpr double half_width_95 = 1.959963984540054;  ///< normal_half_width(0.95)

}  // namespace drift::stats
