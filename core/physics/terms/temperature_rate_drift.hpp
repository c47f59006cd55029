#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// Drift that follows the change of the temperature: gradients in the gyro (Shupe effect of a fibre
/// coil), and a gyro that lags its thermometer, whose drift is another on the way up than down.
struct TemperatureRateDrift {
  static constexpr std::string_view key = "temperature_rate_drift";
  static constexpr std::string_view title =
      "fixed drift by the rate of the temperature, hysteresis";
  static constexpr std::string_view equation = "w_l,i += kT_rate_i dT/dt";
  static constexpr std::string_view source =
      "a lag of tau behind the thermometer is kT_rate = -kT tau: no. 4 and 5 min";
  static constexpr Subsystem subsystem = Subsystem::gyro;
  static constexpr auto params =
      per_axis<"kT_rate">("deg/h*min/degC"_unit, normal(0.0, 0.1), "w_l, times dT/dt");
  static constexpr Needs needs{.covariates = covariate("temperature").set()};
  static constexpr bool wants_swing = true;

  template <class S>
  static void rates(const Inputs<S>& in, const S* k, RateAssembly<S>& out) {
    out.omega_drift_g += vec3(k) * in.rate_of(covariate("temperature"));
  }
};

}  // namespace drift::terms
