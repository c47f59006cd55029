#pragma once

#include <array>
#include <string>
#include <string_view>

#include "core/stats/allan_covariance.hpp"

namespace drift::report {

/// How a sensor's five coefficients are written: unit and its size in rad/s or g and seconds.
struct NoiseUnit {
  std::string_view key;    ///< "N"
  std::string_view words;  ///< "angle random walk"
  std::string symbol;
  double size = 1.0;
};

enum class Sensor { gyro, accelerometer };
inline constexpr Sensor sensors[] = {Sensor::gyro, Sensor::accelerometer};

/// Told by the name of the channel.
inline Sensor sensor_of(std::string_view channel) {
  return channel.starts_with("gyro_") ? Sensor::gyro : Sensor::accelerometer;
}

/// Q N B K R of gyros in arcsec, deg/sqrt(h), deg/h, deg/h/sqrt(h), deg/h/h; of accelerometers in
/// m/s, ug/sqrt(Hz), ug, ug/sqrt(h), ug/h. `gravity` [m/s^2] for the velocity.
std::array<NoiseUnit, stats::allan_noises> noise_units(Sensor sensor, double gravity);

}  // namespace drift::report
