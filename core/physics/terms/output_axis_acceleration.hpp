#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// The float's inertia about its output axis feels angular acceleration, w_l += (J_O/H) w_O'. In a
/// test the rate changes only in steps, so the platform is off by the step while it turns, and back
/// when it stops: an attitude offset.
struct OutputAxisAcceleration {
  static constexpr std::string_view key = "output_axis_acceleration";
  static constexpr std::string_view title =
      "sensitivity to angular acceleration about the output axis";
  static constexpr std::string_view equation = "delta_p,i = -J_i w_ip,O  (J = J_O/H)";
  static constexpr std::string_view source =
      "physics.md 2.1 and 4, no. 29: J_O/H 1e-4 to 1e-3 s; IEEE 292";
  static constexpr Subsystem subsystem = Subsystem::gyro;
  static constexpr auto params =
      per_axis<"J">("ms"_unit, normal(0.0, 0.5), "attitude offset, times -w_ip along OA");

  template <class S>
  static void attitude_offset(const Inputs<S>& in, const S* J, Vec3T<S>& delta_p) {
    const Vec3 omega_o = in.mounting->gyro.along_second(in.omega_cmd_p);
    for (int i = 0; i < 3; ++i) delta_p[i] -= J[i] * omega_o[i];
  }
};

}  // namespace drift::terms
