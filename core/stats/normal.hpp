#pragma once

namespace drift::stats {

/// Standard normal distribution function and its inverse (Boost.Math), both good to a few units in
/// the last place. normal_quantile: 0 < p < 1.
double normal_distribution(double z);
double normal_quantile(double p);

/// Half width of a two-sided interval of this confidence, in standard deviations: 1.96 for 0.95.
double normal_half_width(double confidence);

}  // namespace drift::stats
