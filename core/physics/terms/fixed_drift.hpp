#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// Drift that depends on nothing: D_F of each gyro.
struct FixedDrift {
  static constexpr std::string_view key = "fixed_drift";
  static constexpr std::string_view title = "fixed drift of each gyro";
  static constexpr std::string_view equation = "w_l,i += D_F_i";
  static constexpr std::string_view source = "IEEE 517 gyro model equation; physics.md 2.1";
  static constexpr Subsystem subsystem = Subsystem::gyro;
  static constexpr auto params =
      per_axis<"D_F">(unit::deg_per_h, normal(0.0, 1.0), "w_l, constant");

  template <class S>
  static void rates(const Inputs<S>&, const S* D_F, RateAssembly<S>& out) {
    out.omega_drift_g += vec3(D_F);
  }
};

}  // namespace drift::terms
