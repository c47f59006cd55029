#pragma once

#include <cmath>

#include "core/base/linalg.hpp"
#include "core/base/units.hpp"

namespace drift {

/// Where the test stands. Local axes are North, West, Up.
struct Site {
  double latitude = 0.0;     ///< [rad]
  double gravity = 9.80665;  ///< local g [m/s^2], for recordings in m/s^2
  /// Where North is. Nobody knows: the local axes are those that Up allows, and of the Earth's rate
  /// only what is about Up is known.
  bool north_known = true;

  /// Rate of the Earth about the horizontal, along North [rad/s].
  double north_rate() const { return detail::earth_rate * std::cos(latitude); }
  /// What is known of the rate of the Earth, local axes [rad/s].
  Vec3 omega_ie_l() const {
    return {north_known ? north_rate() : 0.0, 0.0, detail::earth_rate * std::sin(latitude)};
  }
};

inline const Vec3 up_l = Vec3::UnitZ();  ///< specific force at rest, local axes [g]

/// Rotation of the case against the local axes by its heading about Up: v_l = R_lc v_c.
inline Mat3 case_attitude(double heading) {
  return rotation(Vec3(0.0, 0.0, heading));
}

}  // namespace drift
