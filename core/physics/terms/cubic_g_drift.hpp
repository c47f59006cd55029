#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// Third order of the g-sensitive drift. At cardinal attitudes it is D_I.
struct CubicGDrift {
  static constexpr std::string_view key = "cubic_g_drift";
  static constexpr std::string_view title = "cubic g-sensitive drift";
  static constexpr std::string_view equation = "w_l,i += D_III_i a_I^3";
  static constexpr std::string_view source = "physics.md 4, no. 12: 0.005 to 0.02 deg/h/g^3";
  static constexpr Subsystem subsystem = Subsystem::gyro;
  static constexpr auto params =
      per_axis<"D_III">("deg/h/g^3"_unit, normal(0.0, 0.02), "w_l, times a_I^3");

  template <class S>
  static void rates(const Inputs<S>& in, const S* D, RateAssembly<S>& out) {
    out.omega_drift_g += vec3(D).cwiseProduct(in.f_p).cwiseProduct(in.f_p).cwiseProduct(in.f_p);
  }
};

}  // namespace drift::terms
