#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// Drift that grows evenly from the start of the test: ageing.
struct DriftRamp {
  static constexpr std::string_view key = "drift_ramp";
  static constexpr std::string_view title = "linear drift ramp, ageing";
  static constexpr std::string_view equation = "w_l,i += ramp_i t";
  static constexpr std::string_view source = "physics.md 4, no. 1: 0.001 to 0.01 deg/h per hour";
  static constexpr Subsystem subsystem = Subsystem::gyro;
  static constexpr auto params =
      per_axis<"ramp">("deg/h/h"_unit, normal(0.0, 0.01), "w_l, times the time since the start");
  static constexpr Needs needs{.clock = true};

  template <class S>
  static void rates(const Inputs<S>& in, const S* ramp, RateAssembly<S>& out) {
    out.omega_drift_g += vec3(ramp) * in.now().t;
  }
};

}  // namespace drift::terms
