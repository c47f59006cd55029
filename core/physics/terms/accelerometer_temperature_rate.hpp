#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// Bias of the accelerometers that follows the change of the temperature: they lag the thermometer,
/// and read otherwise on the way up than down.
struct AccelerometerTemperatureRate {
  static constexpr std::string_view key = "accelerometer_temperature_rate";
  static constexpr std::string_view title =
      "accelerometer bias by the rate of the temperature, hysteresis";
  static constexpr std::string_view equation = "f_i += K0_T_rate_i dT/dt";
  static constexpr std::string_view source =
      "a lag of tau behind the thermometer is K0_T_rate = -K0_T tau: no. 45 and 5 min";
  static constexpr Subsystem subsystem = Subsystem::accelerometers;
  static constexpr auto params = per_axis<"K0_T_rate">("ug*min/degC"_unit, normal(0.0, 100.0),
                                                       "accelerometer output, times dT/dt");
  static constexpr Needs needs{.covariates = covariate("temperature").set()};
  static constexpr bool wants_swing = true;

  template <class S>
  static void readout(const Inputs<S>& in, const S* p, ReadoutAssembly<S>& out) {
    out.acc += vec3(p) * in.rate_of(covariate("temperature"));
  }
};

}  // namespace drift::terms
