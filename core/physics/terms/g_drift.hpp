#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// Drift from mass unbalance, first order in specific force along input, output and spin axes.
struct GDrift {
  static constexpr std::string_view key = "g_drift";
  static constexpr std::string_view title = "g-sensitive drift (mass unbalance)";
  static constexpr std::string_view equation = "w_l,i += D_I_i a_I + D_O_i a_O + D_S_i a_S";
  static constexpr std::string_view source = "IEEE 517 gyro model equation; physics.md 2.1";
  static constexpr Subsystem subsystem = Subsystem::gyro;
  static constexpr auto params =
      join(per_axis<"D_I">(unit::deg_per_h_per_g, normal(0.0, 2.0), "w_l, times a_I"),
           per_axis<"D_O">(unit::deg_per_h_per_g, normal(0.0, 0.3), "w_l, times a_O"),
           per_axis<"D_S">(unit::deg_per_h_per_g, normal(0.0, 2.0), "w_l, times a_S"));

  template <class S>
  static void rates(const Inputs<S>& in, const S* D, RateAssembly<S>& out) {
    out.omega_drift_g += vec3(D).cwiseProduct(in.f_p) + vec3(D + 3).cwiseProduct(in.f_output()) +
                         vec3(D + 6).cwiseProduct(in.f_spin());
  }
};

}  // namespace drift::terms
