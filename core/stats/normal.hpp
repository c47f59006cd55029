#pragma once

namespace drift::stats {

/// Standard normal distribution function and its inverse (Boost.Math), both good to a few units in
/// the last place. normal_quantile: 0 < p < 1.
double normal_distribution(double z);
double normal_quantile(double p);

/// Half width of a two-sided interval of this confidence, in standard deviations.
double normal_half_width(double confidence);
inline constexpr double beyond_5_sigma = 6e-7;  ///< chance of that or more, on either side
inline constexpr double half_width_95 = 1.959963984540054;  ///< normal_half_width(0.95)

/// Whether a normal distribution of this mean and sigma says of a 95 % interval what it is: beyond
/// either end lies between half and twice of the 2.5 % that should. An end that is not finite is
/// not what it says.
bool normal_says(double mean, double sigma, double low, double high);

}  // namespace drift::stats
