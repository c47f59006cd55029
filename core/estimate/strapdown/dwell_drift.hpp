#pragma once

#include <span>

#include "core/estimate/strapdown/estimate.hpp"

namespace drift::strapdown {

/// What is known of a dwell once the accelerometers are calibrated.
struct Rest {
  Vec3 omega_g;  ///< mean gyro output [rad/s]
  Vec3 f_c;      ///< mean specific force, case axes [g]
};

/// Which drift the gyros are given, each containing the one before.
enum class DriftOrder {
  fixed,         ///< D_F
  input_axis,    ///< and D_I
  g_sensitive,   ///< and D_O, D_S
  g2_sensitive,  ///< and D_II, D_OO, D_IO, D_IS, D_OS
};

/// The parameters an order estimates. D_SS is left out of the last: a_I^2 + a_O^2 + a_S^2 = 1 at
/// rest, so D_F, D_II, D_OO stand for D_F + D_SS, D_II - D_SS, D_OO - D_SS (physics.md 2.4).
std::vector<std::size_t> parameters_of(DriftOrder order);

/// Internal drift w_l of the three gyros [rad/s] at a specific force [g, case axes], from the terms
/// fixed_drift, g_drift and g2_drift.
Vec3 drift_rate(const Theta& theta, const Vec3& f_c);

/// Estimates the drift from dwells, where w_g = w_l (Earth rate is below what is claimed), by
/// linear least squares.
Estimate fit_drift(DriftOrder order, std::span<const Rest> rests);

}  // namespace drift::strapdown
