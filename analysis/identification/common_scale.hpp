#pragma once

#include <optional>

#include "core/estimate/estimate_result.hpp"

namespace drift::identification {

/// What the scale factors K1 of three accelerometers have in common beyond their priors.
struct CommonScale {
  /// [1] their mean from the means of their priors; of the cause, their own scales taken off as far
  /// as the priors know them.
  double value = 0.0, sigma = 0.0;
};

/// Given where the mean of all three is further from those of their priors than
/// FitLimits::beyond_prior sigmas and they differ by no more than their priors let them
/// (FitLimits::unlike_scales): then one cause has moved them, such as the gravity by which readings
/// in m/s^2 became g.
std::optional<CommonScale> common_scale(const EstimateResult& estimate);

}  // namespace drift::identification
