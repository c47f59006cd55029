#pragma once

#include "core/physics/gimbal_friction.hpp"

namespace drift::terms {

/// Friction of the gimbal bearings (Dahl, exponent 1) hangs the platform off against the motion of
/// each gimbal; after a reversal it takes a turn of about F_turn to change sides. Its memory is the
/// friction of each gimbal over its Coulomb friction, driven by the nominal gimbal motion. A
/// reversal is over in seconds and accelerometers are read for minutes, hence `moments`.
struct Stiction : GimbalFriction {
  static constexpr std::string_view key = "stiction";
  static constexpr std::string_view title = "friction of the gimbals";
  static constexpr std::string_view equation =
      "delta_p = -sum over k of F_k T_k e_k,  dT_k/dtheta_k = (sgn theta_k' - T_k) / F_turn";
  static constexpr std::string_view source =
      "physics.md 4, no. 26: Tc c/(K H) 2 to 10 arcsec; Tc 2e-3 to 1e-2 N m over 10 to 100 N m/rad";
  static constexpr Subsystem subsystem = Subsystem::servo;
  static constexpr auto params =
      join(per_gimbal<"F">(unit::arcsec, normal(0.0, 5.0), "attitude offset, friction of a gimbal"),
           profiled<"F_turn">(ParamKind::nonlinear, unit::arcsec, 40.0, {10.0, 40.0, 150.0},
                              "turn over which friction builds up"));

  template <class S>
  static void moments(const PathStep& along, const S* p, const S* T, Moments<S>* moments) {
    moments_of(along, p, T, moments);
  }
  template <class S>
  static void attitude_offset(const Inputs<S>& in, const S* p, const S* T, Vec3T<S>& delta_p) {
    take_off(in, p, T, delta_p);
  }
};

}  // namespace drift::terms
