#pragma once

#include "core/physics/gimbal_friction.hpp"

namespace drift::terms {

/// An elastic restraint of the floats (pigtails) turns what hangs the platform off into drift,
/// k_f theta / H: here the friction of the gimbals, with the memory that `stiction` has. A reversal
/// is over in seconds and steps take minutes, hence `moments`.
struct FloatRestraint : GimbalFriction {
  static constexpr std::string_view key = "float_restraint";
  static constexpr std::string_view title = "elastic restraint of the floats under gimbal friction";
  static constexpr std::string_view equation =
      "w_ip += -sum over k of P_k T_k e_k,  dT_k/dtheta_k = (sgn theta_k' - T_k) / P_turn";
  static constexpr std::string_view source =
      "physics.md 1.5 and 4, no. 28: hang-off of 10 arcsec x k_f/H of 0.005 1/s is 0.05 deg/h";
  static constexpr Subsystem subsystem = Subsystem::gyro;
  static constexpr auto params = join(
      per_gimbal<"P">(unit::deg_per_h, normal(0.0, 0.03), "platform rate, friction of a gimbal"),
      profiled<"P_turn">(ParamKind::nonlinear, unit::arcsec, 40.0, {10.0, 40.0, 150.0},
                         "turn over which friction builds up"));

  template <class S>
  static void moments(const PathStep& along, const S* p, const S* T, Moments<S>* moments) {
    moments_of(along, p, T, moments);
  }
  template <class S>
  static void rates(const Inputs<S>& in, const S* p, const S* T, RateAssembly<S>& out) {
    take_off(in, p, T, out.omega_ip_p);
  }
};

}  // namespace drift::terms
