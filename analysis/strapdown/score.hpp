#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace drift::strapdown {

/// Size of the errors of a model on one kind of data.
struct Score {
  std::size_t count = 0;         ///< dwells or rotations
  double in_sample = 0.0;        ///< root mean square on the data of the fit
  double held_out = 0.0;         ///< root mean square on data held out of the fit
  double low = 0.0, high = 0.0;  ///< 95 % of `held_out`, bootstrap over dwells or rotations
  double median = 0.0;           ///< of the held-out errors
  std::vector<double> errors;    ///< held out, one per dwell or rotation
};

/// Root mean square; NaN of nothing.
double root_mean_square(const std::vector<double>& errors);

/// Score of errors given in some unit, shown in units of `unit` of it.
Score score_of(const std::vector<double>& in_sample, const std::vector<double>& held_out,
               double unit, std::uint64_t seed);

/// Mean of (before - after) over its standard error: how surely the errors `after` are smaller.
/// Zero where no pair differs; NaN if an error is none.
double paired_gain(const std::vector<double>& before, const std::vector<double>& after);

}  // namespace drift::strapdown
