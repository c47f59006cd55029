#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace drift::blind {

/// The part of the platform that a term belongs to, as physics.md 4 groups them; "other" for an
/// unknown key.
inline std::string_view subsystem_of(std::string_view term) {
  constexpr std::pair<std::string_view, std::string_view> known[] = {
      {"fixed_drift", "gyro"},
      {"g_drift", "gyro"},
      {"g2_drift", "gyro"},
      {"gyro_misalignment", "gyro"},
      {"drift_ramp", "gyro"},
      {"warmup_drift", "gyro"},
      {"reposition_transient", "gyro"},
      {"temperature_drift", "gyro"},
      {"temperature_g_drift", "gyro"},
      {"mass_unbalance_step", "gyro"},
      {"bistable_drift", "gyro"},
      {"drift_random_walk", "gyro"},
      {"cubic_g_drift", "gyro"},
      {"gimbal_angle_drift", "gyro"},
      {"magnetic_drift", "gyro"},
      {"misalignment_creep", "gyro"},
      {"output_axis_acceleration", "gyro"},
      {"float_restraint", "gyro"},
      {"torquer_scale", "torquer"},
      {"torquer_asymmetry", "torquer"},
      {"torquer_nonlinearity", "torquer"},
      {"torquer_heating", "torquer"},
      {"torquer_crosstalk", "torquer"},
      {"hang_off", "servo"},
      {"stiction", "servo"},
      {"servo_lag", "servo"},
      {"base_motion_leak", "servo"},
      {"frame_closure", "servo"},
      {"sag", "platform structure"},
      {"latitude_error", "site"},
      {"azimuth_error", "site"},
      {"pier_tilt", "site"},
      {"pier_azimuth", "site"},
      {"encoder_harmonics", "resolvers"},
      {"gimbal_nonorthogonality", "resolvers"},
      {"timing_skew", "resolvers"},
      {"accelerometer", "accelerometers"},
      {"accelerometer_temperature", "accelerometers"},
      {"accelerometer_asymmetry", "accelerometers"},
      {"accelerometer_cross", "accelerometers"},
      {"accelerometer_dead_zone", "accelerometers"},
      {"accelerometer_ramp", "accelerometers"}};
  for (const auto& [key, part] : known)
    if (key == term) return part;
  return "other";
}

}  // namespace drift::blind
