#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// Bias of the accelerometers that grows evenly from the start of the test.
struct AccelerometerRamp {
  static constexpr std::string_view key = "accelerometer_ramp";
  static constexpr std::string_view title = "accelerometer bias ramp";
  static constexpr std::string_view equation = "f_i += K0_ramp_i t";
  static constexpr std::string_view source = "physics.md 4, no. 49: 0.2 to 2 ug/h";
  static constexpr Subsystem subsystem = Subsystem::accelerometers;
  static constexpr auto params =
      per_axis<"K0_ramp">("ug/h"_unit, normal(0.0, 1.0), "accelerometer output, times the time");
  static constexpr Needs needs{.clock = true};

  template <class S>
  static void readout(const Inputs<S>& in, const S* K0_ramp, ReadoutAssembly<S>& out) {
    out.acc += vec3(K0_ramp) * in.now().t;
  }
};

}  // namespace drift::terms
