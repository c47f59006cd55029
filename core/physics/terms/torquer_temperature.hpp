#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// The scale factor of the torquers follows the temperature, to third order.
struct TorquerTemperature {
  static constexpr std::string_view key = "torquer_temperature";
  static constexpr std::string_view title = "temperature coefficients of the torquer scale factor";
  static constexpr std::string_view equation =
      "w_md,i += -(s_T_i dT + s_T2_i dT^2 + s_T3_i dT^3) w_cmd,i";
  static constexpr std::string_view source =
      "magnets 50 to 200 ppm/degC; third-order calibration of strapdown gyros";
  static constexpr Subsystem subsystem = Subsystem::torquer;
  static constexpr auto params =
      join(per_axis<"s_T">("ppm/degC"_unit, normal(0.0, 50.0), "w_md, times -w_cmd dT"),
           per_axis<"s_T2">("ppm/degC^2"_unit, normal(0.0, 1.5), "w_md, times -w_cmd dT^2"),
           per_axis<"s_T3">("ppm/degC^3"_unit, normal(0.0, 0.05), "w_md, times -w_cmd dT^3"));
  static constexpr Needs needs{.covariates = covariate("temperature").set()};
  static constexpr bool wants_swing = true;

  template <class S>
  static void rates(const Inputs<S>& in, const S* s, RateAssembly<S>& out) {
    const double dT = in.value_of(covariate("temperature"));
    for (int i = 0; i < 3; ++i)
      out.omega_torque_g[i] -= (s[i] + (s[3 + i] + s[6 + i] * dT) * dT) * (dT * in.omega_cmd_p[i]);
  }
};

}  // namespace drift::terms
