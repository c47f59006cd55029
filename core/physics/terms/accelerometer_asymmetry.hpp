#pragma once

#include <cmath>

#include "core/physics/term.hpp"

namespace drift::terms {

/// The scale factor of an accelerometer differs between the two signs of its input.
struct AccelerometerAsymmetry {
  static constexpr std::string_view key = "accelerometer_asymmetry";
  static constexpr std::string_view title = "accelerometer scale factor asymmetry (odd quadratic)";
  static constexpr std::string_view equation = "f_i += K_oq_i a_I |a_I|";
  static constexpr std::string_view source = "physics.md 2.2 and 4, no. 46: 5 to 50 ppm";
  static constexpr Subsystem subsystem = Subsystem::accelerometers;
  static constexpr auto params =
      per_axis<"K_oq">(unit::ug_per_g2, normal(0.0, 30.0), "accelerometer output, times a_I |a_I|");

  template <class S>
  static void readout(const Inputs<S>& in, const S* K, ReadoutAssembly<S>& out) {
    using std::abs;
    for (int i = 0; i < 3; ++i) out.acc[i] += K[i] * in.f_p[i] * abs(in.f_p[i]);
  }
};

}  // namespace drift::terms
