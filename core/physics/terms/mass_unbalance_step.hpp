#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// The mass unbalance of a gyro shifts at one moment (bearing, lubricant, shock). The step is
/// smooth over four minutes, so that integrators of fixed step see all of it.
struct MassUnbalanceStep {
  static constexpr std::string_view key = "mass_unbalance_step";
  static constexpr std::string_view title = "step of the mass unbalance";
  static constexpr std::string_view equation =
      "w_l,i += dD_I_i a_I (1 + tanh((t - dD_t0) / 120 s)) / 2";
  static constexpr std::string_view source =
      "physics.md 4, no. 6: 0.01 to 0.4 deg/h/g; Miller & Feldman, J. Spacecraft 1968";
  static constexpr Subsystem subsystem = Subsystem::gyro;
  static constexpr auto params = join(
      per_axis<"dD_I">(unit::deg_per_h_per_g, normal(0.0, 0.2), "w_l, times a_I after the step"),
      moment<"dD_t0">(unit::hour, 6.0, "time of the step since the start of the test"));
  static constexpr Needs needs{.clock = true};
  static constexpr double width = 120.0;  // [s]

  template <class S>
  static void rates(const Inputs<S>& in, const S* p, RateAssembly<S>& out) {
    using std::tanh;
    const S done = 0.5 * (1.0 + tanh((in.now().t - p[3]) / width));
    out.omega_drift_g += vec3(p).cwiseProduct(in.f_p) * done;
  }
};

}  // namespace drift::terms
