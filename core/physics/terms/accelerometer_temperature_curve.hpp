#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// What bias and scale of the accelerometers owe to the temperature beyond the first order.
struct AccelerometerTemperatureCurve {
  static constexpr std::string_view key = "accelerometer_temperature_curve";
  static constexpr std::string_view title = "curved temperature dependence of the accelerometers";
  static constexpr std::string_view equation =
      "f_i += (K0_T2_i + K1_T2_i a_I) dT^2 + (K0_T3_i + K1_T3_i a_I) dT^3";
  static constexpr std::string_view source =
      "third-order calibration of accelerometers; at 10 degC a third, a tenth of no. 45";
  static constexpr Subsystem subsystem = Subsystem::accelerometers;
  static constexpr auto params = join(
      per_axis<"K0_T2">("ug/degC^2"_unit, normal(0.0, 0.7), "accelerometer output, times dT^2"),
      per_axis<"K0_T3">("ug/degC^3"_unit, normal(0.0, 0.02), "accelerometer output, times dT^3"),
      per_axis<"K1_T2">("ppm/degC^2"_unit, normal(0.0, 1.5),
                        "accelerometer output, times a_I dT^2"),
      per_axis<"K1_T3">("ppm/degC^3"_unit, normal(0.0, 0.05),
                        "accelerometer output, times a_I dT^3"));
  static constexpr Needs needs{.covariates = covariate("temperature").set()};
  static constexpr bool wants_swing = true;

  template <class S>
  static void readout(const Inputs<S>& in, const S* p, ReadoutAssembly<S>& out) {
    const double dT = in.value_of(covariate("temperature"));
    const Vec3T<S> bias = vec3(p) + vec3(p + 3) * dT, scale = vec3(p + 6) + vec3(p + 9) * dT;
    out.acc += (bias + scale.cwiseProduct(in.f_p)) * (dT * dT);
  }
};

}  // namespace drift::terms
