#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// What the fixed drift owes to the temperature beyond the first order.
struct TemperatureDriftCurve {
  static constexpr std::string_view key = "temperature_drift_curve";
  static constexpr std::string_view title = "curved temperature dependence of the fixed drift";
  static constexpr std::string_view equation = "w_l,i += kT2_i dT^2 + kT3_i dT^3";
  static constexpr std::string_view source =
      "third-order calibration of strapdown gyros; at 10 degC a third, a tenth of no. 4";
  static constexpr Subsystem subsystem = Subsystem::gyro;
  static constexpr auto params =
      join(per_axis<"kT2">("deg/h/degC^2"_unit, normal(0.0, 1e-3), "w_l, times dT^2"),
           per_axis<"kT3">("deg/h/degC^3"_unit, normal(0.0, 3e-5), "w_l, times dT^3"));
  static constexpr Needs needs{.covariates = covariate("temperature").set()};
  static constexpr bool wants_swing = true;

  template <class S>
  static void rates(const Inputs<S>& in, const S* k, RateAssembly<S>& out) {
    const double dT = in.value_of(covariate("temperature"));
    out.omega_drift_g += vec3(k) * (dT * dT) + vec3(k + 3) * (dT * dT * dT);
  }
};

}  // namespace drift::terms
