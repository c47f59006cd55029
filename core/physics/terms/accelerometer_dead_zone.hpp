#pragma once

#include "core/base/dual.hpp"
#include "core/physics/term.hpp"

namespace drift::terms {

/// An accelerometer says too little by Z wherever its input is not near zero: a dead zone, smooth
/// over Z_width.
struct AccelerometerDeadZone {
  static constexpr std::string_view key = "accelerometer_dead_zone";
  static constexpr std::string_view title = "dead zone of the accelerometers";
  static constexpr std::string_view equation = "f_i += -Z_i tanh(a_I / Z_width)";
  static constexpr std::string_view source = "physics.md 4, no. 48: 2 to 20 ug near a = 0";
  static constexpr Subsystem subsystem = Subsystem::accelerometers;
  static constexpr auto params =
      join(per_axis<"Z">(unit::ug, normal(0.0, 10.0), "accelerometer output, times -sgn a_I"),
           profiled<"Z_width">(ParamKind::nonlinear, unit::ug, 500.0, {100.0, 500.0, 2000.0},
                               "input over which the dead zone ends"));
  static constexpr double least = 1e-6;  // [g]: a filter's step cannot make the width vanish

  template <class S>
  static void readout(const Inputs<S>& in, const S* p, ReadoutAssembly<S>& out) {
    using std::tanh;
    const S width = at_least(p[3], least);
    for (int i = 0; i < 3; ++i) out.acc[i] -= p[i] * tanh(in.f_p[i] / width);
  }
};

}  // namespace drift::terms
