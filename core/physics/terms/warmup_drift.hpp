#pragma once

#include "core/physics/memory.hpp"
#include "core/physics/term.hpp"

namespace drift::terms {

/// Drift that dies out as the platform warms up after the start of the test.
struct WarmupDrift {
  static constexpr std::string_view key = "warmup_drift";
  static constexpr std::string_view title = "warm-up drift";
  static constexpr std::string_view equation = "w_l,i += W_i exp(-t / W_tau)";
  static constexpr std::string_view source =
      "physics.md 4, no. 2: 0.02 to 0.5 deg/h, tau 20 to 120 min";
  static constexpr Subsystem subsystem = Subsystem::gyro;
  static constexpr auto params =
      join(per_axis<"W">(unit::deg_per_h, normal(0.0, 0.2), "w_l, at the start of the test"),
           profiled<"W_tau">(ParamKind::nonlinear, unit::minute, 40.0, {20.0, 40.0, 80.0, 120.0},
                             "w_l, time constant of the warm-up"));
  static constexpr Needs needs{.clock = true};

  template <class S>
  static void rates(const Inputs<S>& in, const S* p, RateAssembly<S>& out) {
    using std::exp;
    const S left = exp(-in.now().t / time_constant(p[3]));
    out.omega_drift_g += vec3(p) * left;
  }
};

}  // namespace drift::terms
