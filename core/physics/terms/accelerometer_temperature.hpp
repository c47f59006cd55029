#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// Bias and scale of the accelerometers follow the temperature.
struct AccelerometerTemperature {
  static constexpr std::string_view key = "accelerometer_temperature";
  static constexpr std::string_view title = "temperature coefficients of the accelerometers";
  static constexpr std::string_view equation = "f_i += (K0_T_i + K1_T_i a_I) dT";
  static constexpr std::string_view source =
      "physics.md 4, no. 45: 5 to 50 ug/degC, 20 to 200 ppm/degC";
  static constexpr Subsystem subsystem = Subsystem::accelerometers;
  static constexpr auto params = join(
      per_axis<"K0_T">("ug/degC"_unit, normal(0.0, 20.0), "accelerometer output, times dT"),
      per_axis<"K1_T">("ppm/degC"_unit, normal(0.0, 50.0), "accelerometer output, times a_I dT"));
  static constexpr Needs needs{.covariates = covariate("temperature").set()};

  template <class S>
  static void readout(const Inputs<S>& in, const S* p, ReadoutAssembly<S>& out) {
    out.acc += (vec3(p) + vec3(p + 3).cwiseProduct(in.f_p)) * in.value_of(covariate("temperature"));
  }
};

}  // namespace drift::terms
