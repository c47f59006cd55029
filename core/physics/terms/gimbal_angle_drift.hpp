#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// Drift that follows the angle of one gimbal: heat flow, slip-ring leads, stray fields of the
/// gimbal.
struct GimbalAngleDrift {
  static constexpr std::string_view key = "gimbal_angle_drift";
  static constexpr std::string_view title = "drift that depends on a gimbal angle";
  static constexpr std::string_view equation =
      "w_l,i += G_c_i cos(theta_k) + G_s_i sin(theta_k),  k = G_gimbal (1 outer, 2 middle, 3 "
      "inner)";
  static constexpr std::string_view source = "physics.md 4, no. 17: 0.002 to 0.02 deg/h";
  static constexpr Subsystem subsystem = Subsystem::gyro;
  static constexpr Prior prior = normal(0.0, 0.01);
  static constexpr auto params =
      join(per_axis<"G_c">(unit::deg_per_h, prior, "w_l, times the cosine of the gimbal angle"),
           per_axis<"G_s">(unit::deg_per_h, prior, "w_l, times the sine of the gimbal angle"),
           profiled<"G_gimbal">(ParamKind::discrete, unit::one, 3.0, {1.0, 2.0, 3.0},
                                "which gimbal: 1 outer, 2 middle, 3 inner"));
  static constexpr Needs needs{.gimbals = true};

  template <class S>
  static void rates(const Inputs<S>& in, const S* p, RateAssembly<S>& out) {
    using std::cos;
    using std::sin;
    const S angle = in.around->gimbal[gimbal_number(p[6])];
    out.omega_drift_g += vec3(p) * cos(angle) + vec3(p + 3) * sin(angle);
  }
};

}  // namespace drift::terms
