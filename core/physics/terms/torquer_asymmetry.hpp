#pragma once

#include <cmath>

#include "core/physics/term.hpp"

namespace drift::terms {

/// The torquer's scale factor differs between the two signs of the command.
struct TorquerAsymmetry {
  static constexpr std::string_view key = "torquer_asymmetry";
  static constexpr std::string_view title = "torquer scale factor asymmetry";
  static constexpr std::string_view equation = "w_md,i += -s_a_i |w_cmd,i|";
  static constexpr std::string_view source = "physics.md 2.1 and 4, no. 19: 10 to 100 ppm";
  static constexpr Subsystem subsystem = Subsystem::torquer;
  static constexpr auto params =
      per_axis<"s_a">(unit::ppm, normal(0.0, 100.0), "w_md, times -|w_cmd|");

  template <class S>
  static void rates(const Inputs<S>& in, const S* s_a, RateAssembly<S>& out) {
    for (int i = 0; i < 3; ++i) out.omega_torque_g[i] -= s_a[i] * std::abs(in.omega_cmd_p[i]);
  }
};

}  // namespace drift::terms
