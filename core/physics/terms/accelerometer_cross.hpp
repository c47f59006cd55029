#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// Products of specific forces that the base model of an accelerometer does not have.
struct AccelerometerCross {
  static constexpr std::string_view key = "accelerometer_cross";
  static constexpr std::string_view title = "further cross terms of the accelerometers";
  static constexpr std::string_view equation =
      "f_i += K_io a_I a_O + K_po a_P a_O + K_pp a_P^2 + K_oo a_O^2";
  static constexpr std::string_view source = "physics.md 2.2 and 4, no. 47: 5 to 50 ug/g^2";
  static constexpr Subsystem subsystem = Subsystem::accelerometers;
  static constexpr Prior prior = normal(0.0, 20.0);
  static constexpr auto params =
      join(per_axis<"K_io">(unit::ug_per_g2, prior, "accelerometer output, times a_I a_O"),
           per_axis<"K_po">(unit::ug_per_g2, prior, "accelerometer output, times a_P a_O"),
           per_axis<"K_pp">(unit::ug_per_g2, prior, "accelerometer output, times a_P^2"),
           per_axis<"K_oo">(unit::ug_per_g2, prior, "accelerometer output, times a_O^2"));

  template <class S>
  static void readout(const Inputs<S>& in, const S* K, ReadoutAssembly<S>& out) {
    const Vec3T<S> a_p = in.mounting->accelerometer.along_second(in.f_p);
    const Vec3T<S> a_o = in.mounting->accelerometer.along_third(in.f_p);
    for (int i = 0; i < 3; ++i)
      out.acc[i] += K[i] * in.f_p[i] * a_o[i] + K[3 + i] * a_p[i] * a_o[i] +
                    K[6 + i] * a_p[i] * a_p[i] + K[9 + i] * a_o[i] * a_o[i];
  }
};

}  // namespace drift::terms
