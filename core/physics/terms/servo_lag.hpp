#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// The platform lags behind while it turns against its case, by as much as the loop needs to drive
/// it: seen in slews.
struct ServoLag {
  static constexpr std::string_view key = "servo_lag";
  static constexpr std::string_view title = "velocity lag of the servo loop";
  static constexpr std::string_view equation = "delta_p,i = -L_i w_cp,i";
  static constexpr std::string_view source =
      "physics.md 4, no. 27: 0.01 arcsec of viscous friction to some arcsec at 0.5 deg/s";
  static constexpr Subsystem subsystem = Subsystem::servo;
  static constexpr auto params =
      per_axis<"L">("ms"_unit, normal(0.0, 1.0), "attitude offset, times -w_cp");

  template <class S>
  static void attitude_offset(const Inputs<S>& in, const S* L, Vec3T<S>& delta_p) {
    delta_p -= vec3(L).cwiseProduct(in.omega_cp_p());
  }
};

}  // namespace drift::terms
