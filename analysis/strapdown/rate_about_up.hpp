#pragma once

#include <optional>
#include <vector>

#include "core/base/linalg.hpp"

namespace drift::strapdown {

/// What gyros at rest read about Up beside their drifts: the Earth's rate.
struct RateAboutUp {
  double rate = 0.0, sigma = 0.0;  ///< [rad/s]; sigma by the scatter of the rests
};

/// Least squares of a drift of each gyro and one rate about Up. up: of every rest, a unit vector in
/// the axes of the gyros; gyro: what they read there [rad/s]. Nothing where there are fewer than
/// five rests, and where their attitudes do not tell the rate from drifts: its variance must be no
/// larger than that of one rest.
std::optional<RateAboutUp> rate_about_up(const std::vector<Vec3>& up,
                                         const std::vector<Vec3>& gyro);

}  // namespace drift::strapdown
