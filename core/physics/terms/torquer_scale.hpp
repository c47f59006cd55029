#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// Scale factor errors of the gyro torquers. Without this term the torquers are exact.
struct TorquerScale {
  static constexpr std::string_view key = "torquer_scale";
  static constexpr std::string_view title = "torquer scale factor error";
  static constexpr std::string_view equation = "w_md,i = -(1 + s_i) w_cmd,i";
  static constexpr std::string_view source = "physics.md 1.1 and 2.1";
  static constexpr Subsystem subsystem = Subsystem::torquer;
  static constexpr auto params =
      per_axis<"s">(unit::ppm, normal(0.0, 1000.0), "w_md, times -w_cmd");

  template <class S>
  static void rates(const Inputs<S>& in, const S* s, RateAssembly<S>& out) {
    for (int i = 0; i < 3; ++i) out.omega_torque_g[i] -= s[i] * in.omega_cmd_p[i];
  }
};

}  // namespace drift::terms
