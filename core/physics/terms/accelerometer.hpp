#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// Accelerometer model equation. Without this term the accelerometers are ideal.
struct Accelerometer {
  static constexpr std::string_view key = "accelerometer";
  static constexpr std::string_view title = "accelerometer errors";
  static constexpr std::string_view equation =
      "f_i = K0 + (1 + K1)(a_I + dP a_P + dO a_O) + K2 a_I^2 + K3 a_I^3 + K_ip a_I a_P";
  static constexpr std::string_view source = "IEEE 1293 accelerometer model; physics.md 2.2";
  static constexpr Subsystem subsystem = Subsystem::accelerometers;
  static constexpr auto params = join(
      per_axis<"K0">(unit::ug, normal(0.0, 500.0), "accelerometer output, bias"),
      per_axis<"K1">(unit::ppm, normal(0.0, 500.0), "accelerometer output, times a_I"),
      per_axis<"K2">(unit::ug_per_g2, normal(0.0, 50.0), "accelerometer output, times a_I^2"),
      per_axis<"K3">(unit::ug_per_g3, normal(0.0, 20.0), "accelerometer output, times a_I^3"),
      per_axis<"K_ip">(unit::ug_per_g2, normal(0.0, 50.0), "accelerometer output, times a_I a_P"),
      per_axis<"dP">(unit::arcsec, normal(0.0, 100.0), "accelerometer output, times a_P"),
      per_axis<"dO">(unit::arcsec, normal(0.0, 100.0), "accelerometer output, times a_O"));

  template <class S>
  static void readout(const Inputs<S>& in, const S* p, ReadoutAssembly<S>& out) {
    const Vec3T<S>& a_i = in.f_p;
    const Vec3T<S> a_p = in.mounting->accelerometer.along_second(in.f_p);
    const Vec3T<S> a_o = in.mounting->accelerometer.along_third(in.f_p);
    for (int i = 0; i < 3; ++i) {
      const S K0 = p[i], K1 = p[3 + i], K2 = p[6 + i], K3 = p[9 + i], K_ip = p[12 + i];
      const S dP = p[15 + i], dO = p[18 + i];
      const S tilted = dP * a_p[i] + dO * a_o[i];
      out.acc[i] += K0 + K1 * a_i[i] + (1.0 + K1) * tilted +
                    a_i[i] * (K2 * a_i[i] + K3 * a_i[i] * a_i[i] + K_ip * a_p[i]);
    }
  }
};

}  // namespace drift::terms
