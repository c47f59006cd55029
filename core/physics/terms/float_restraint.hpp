#pragma once

#include "core/physics/gimbals.hpp"
#include "core/physics/memory.hpp"
#include "core/physics/term.hpp"

namespace drift::terms {

/// An elastic restraint of the floats (pigtails) turns what hangs the platform off into drift,
/// k_f theta / H: here the friction of the gimbals, with the memory that `stiction` has. A reversal
/// is over in seconds; fixed steps see it to within P times a sixth of a step, 0.2 arcsec.
struct FloatRestraint {
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
  static constexpr Needs needs{.gimbals = true};
  static constexpr int memory = 3;
  static constexpr std::size_t memory_parameter = 3;

  template <class S>
  static void start(const PathStep&, const S*, S* T) {
    start_friction(T);
  }
  template <class S>
  static void advance(const PathStep& along, const S* p, S* T) {
    advance_friction(along, p[3], T);
  }
  template <class S>
  static void rates(const Inputs<S>& in, const S* p, const S* T, RateAssembly<S>& out) {
    const Mat3T<S> axes = gimbal_axes(in.around->gimbal);
    for (int k = 0; k < 3; ++k) out.omega_ip_p -= axes.col(k) * (p[k] * T[k]);
  }
};

}  // namespace drift::terms
