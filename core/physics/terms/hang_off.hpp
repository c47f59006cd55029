#pragma once

#include "core/physics/gimbals.hpp"
#include "core/physics/term.hpp"

namespace drift::terms {

/// Constant torques hang the platform off by as much as the loop needs to balance them: flex leads
/// (a sine of each gimbal's angle, about its axis) and a centre of mass off the centre (u x a). An
/// offset, no drift. A torque that never changes is part of the attitude at caging.
struct HangOff {
  static constexpr std::string_view key = "hang_off";
  static constexpr std::string_view title = "hang-off of the platform under torques";
  static constexpr std::string_view equation =
      "delta_p = sum over gimbals k of H_k sin(theta_k) e_k + H_u x a";
  static constexpr std::string_view source = "physics.md 1.5 and 4, no. 25: 1 to 20 arcsec";
  static constexpr Subsystem subsystem = Subsystem::servo;
  static constexpr auto params =
      join(per_gimbal<"H">(unit::arcsec, normal(0.0, 5.0), "attitude offset, flex leads"),
           per_axis<"H_u">("arcsec/g"_unit, normal(0.0, 5.0), "attitude offset, unbalance"));
  static constexpr Needs needs{.gimbals = true};

  template <class S>
  static void attitude_offset(const Inputs<S>& in, const S* p, Vec3T<S>& delta_p) {
    using std::sin;
    const Vec3T<S>& angle = in.around->gimbal;
    const Mat3T<S> axes = gimbal_axes(angle);
    for (int k = 0; k < 3; ++k) delta_p += axes.col(k) * (p[k] * sin(angle[k]));
    delta_p += vec3(p + 3).cross(in.f_p);
  }
};

}  // namespace drift::terms
