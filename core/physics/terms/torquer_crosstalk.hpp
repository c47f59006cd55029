#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// A command about one axis also torques the gyros of the others. In slews it cannot be told from
/// lambda E (physics.md 1.7).
struct TorquerCrosstalk {
  static constexpr std::string_view key = "torquer_crosstalk";
  static constexpr std::string_view title = "cross-talk between the torquing channels";
  static constexpr std::string_view equation =
      "w_md,i += -(X_S_i w_cmd,S + X_O_i w_cmd,O), the commands along the gyro's spin and output "
      "axes";
  static constexpr std::string_view source = "physics.md 1.7 and 4, no. 22: 5 to 50 ppm";
  static constexpr Subsystem subsystem = Subsystem::torquer;
  static constexpr auto params = join(
      per_axis<"X_S">(unit::ppm, normal(0.0, 50.0), "w_md, times -w_cmd along the spin axis"),
      per_axis<"X_O">(unit::ppm, normal(0.0, 50.0), "w_md, times -w_cmd along the output axis"));

  template <class S>
  static void rates(const Inputs<S>& in, const S* X, RateAssembly<S>& out) {
    const Vec3 spin = in.mounting->gyro.along_third(in.omega_cmd_p);
    const Vec3 output = in.mounting->gyro.along_second(in.omega_cmd_p);
    for (int i = 0; i < 3; ++i) out.omega_torque_g[i] -= X[i] * spin[i] + X[3 + i] * output[i];
  }
};

}  // namespace drift::terms
