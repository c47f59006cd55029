#include "analysis/report/noise/noise_units.hpp"

#include <cmath>

#include "core/base/units.hpp"

namespace drift::report {

namespace {

std::array<NoiseUnit, stats::allan_noises> gyro_units() {
  const double per_hour = unit::deg_per_h.to_si, root = std::sqrt(unit::hour.to_si);
  return {{{"Q", "quantisation", "arcsec", unit::arcsec.to_si},
           {"N", "angle random walk", "deg/sqrt(h)", unit::deg_per_sqrt_h.to_si},
           {"B", "bias instability", "deg/h", per_hour},
           {"K", "rate random walk", "deg/h/sqrt(h)", per_hour / root},
           {"R", "rate ramp", "deg/h/h", per_hour / unit::hour.to_si}}};
}

std::array<NoiseUnit, stats::allan_noises> accelerometer_units(double gravity) {
  const double ug = unit::ug.to_si, root = std::sqrt(unit::hour.to_si);
  // One ug per root of a hertz is one ug times the root of a second.
  return {{{"Q", "quantisation", "m/s", 1.0 / gravity},
           {"N", "velocity random walk", "ug/sqrt(Hz)", ug},
           {"B", "bias instability", "ug", ug},
           {"K", "acceleration random walk", "ug/sqrt(h)", ug / root},
           {"R", "ramp", "ug/h", ug / unit::hour.to_si}}};
}

}  // namespace

std::array<NoiseUnit, stats::allan_noises> noise_units(Sensor sensor, double gravity) {
  return sensor == Sensor::gyro ? gyro_units() : accelerometer_units(gravity);
}

}  // namespace drift::report
