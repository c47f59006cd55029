#pragma once

#include <array>
#include <optional>

#include "core/estimate/estimate_result.hpp"
#include "core/physics/term_library.hpp"

namespace drift::identification {

/// Three scale factors that one cause moves alike: K1 of the accelerometers, s of the torquers.
using ScaleFactors = std::array<std::size_t, 3>;
inline constexpr ScaleFactors accelerometer_scales{
    TermLibrary::index("K1_x"), TermLibrary::index("K1_y"), TermLibrary::index("K1_z")};
inline constexpr ScaleFactors torquer_scales{TermLibrary::index("s_x"), TermLibrary::index("s_y"),
                                             TermLibrary::index("s_z")};

/// What three scale factors have in common beyond their priors.
struct CommonScale {
  /// [1] their mean from the means of their priors; of the cause, their own scales taken off as far
  /// as the priors know them.
  double value = 0.0, sigma = 0.0;
};

/// Given where the mean of all three is further from those of their priors than
/// FitLimits::beyond_prior sigmas and they differ by no more than their priors let them
/// (FitLimits::unlike_scales): then one cause has moved them, such as the gravity by which readings
/// in m/s^2 became g, or a clock.
std::optional<CommonScale> common_scale(const EstimateResult& estimate,
                                        const ScaleFactors& scales = accelerometer_scales);

/// The estimate of a batch fit without what the priors of these three cost its statistic: what the
/// data leave where one cause has moved them.
EstimateResult without_prior_cost(EstimateResult estimate,
                                  const ScaleFactors& scales = accelerometer_scales);

}  // namespace drift::identification
