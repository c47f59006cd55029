#pragma once

#include <cmath>

#include "core/physics/term.hpp"

namespace drift::terms {

/// The torquer's scale factor depends on how large the command is; given at 0.5 deg/s.
struct TorquerNonlinearity {
  static constexpr std::string_view key = "torquer_nonlinearity";
  static constexpr std::string_view title = "torquer nonlinearity";
  static constexpr std::string_view equation = "w_md,i += -s_2_i w_cmd,i |w_cmd,i| / (0.5 deg/s)";
  static constexpr std::string_view source =
      "physics.md 2.1 and 4, no. 20: 50 to 200 ppm of full scale";
  static constexpr Subsystem subsystem = Subsystem::torquer;
  static constexpr auto params =
      per_axis<"s_2">(unit::ppm, normal(0.0, 150.0), "w_md, times -w_cmd |w_cmd|");
  static constexpr double full_scale = 0.5 * detail::deg;  // [rad/s]

  template <class S>
  static void rates(const Inputs<S>& in, const S* s_2, RateAssembly<S>& out) {
    for (int i = 0; i < 3; ++i) {
      const double w = in.omega_cmd_p[i];
      out.omega_torque_g[i] -= s_2[i] * (w * std::abs(w) / full_scale);
    }
  }
};

}  // namespace drift::terms
