#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// Fixed drift that follows the temperature of the recording.
struct TemperatureDrift {
  static constexpr std::string_view key = "temperature_drift";
  static constexpr std::string_view title = "temperature coefficient of the fixed drift";
  static constexpr std::string_view equation = "w_l,i += kT_i dT";
  static constexpr std::string_view source = "physics.md 4, no. 4: 0.002 to 0.05 deg/h/degC";
  static constexpr Subsystem subsystem = Subsystem::gyro;
  static constexpr auto params = per_axis<"kT">("deg/h/degC"_unit, normal(0.0, 0.03),
                                                "w_l, times the deviation of temperature");
  static constexpr Needs needs{.covariates = covariate("temperature").set()};

  template <class S>
  static void rates(const Inputs<S>& in, const S* k, RateAssembly<S>& out) {
    out.omega_drift_g += vec3(k) * in.value_of(covariate("temperature"));
  }
};

}  // namespace drift::terms
