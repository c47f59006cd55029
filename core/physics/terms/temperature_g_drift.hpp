#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// g-sensitive drift that follows the temperature: density of the flotation fluid.
struct TemperatureGDrift {
  static constexpr std::string_view key = "temperature_g_drift";
  static constexpr std::string_view title = "temperature coefficient of the g-sensitive drift";
  static constexpr std::string_view equation = "w_l,i += (kT_I_i a_I + kT_S_i a_S) dT";
  static constexpr std::string_view source = "physics.md 4, no. 5: 0.005 to 0.05 deg/h/g/degC";
  static constexpr Subsystem subsystem = Subsystem::gyro;
  static constexpr Prior prior = normal(0.0, 0.03);
  static constexpr auto params =
      join(per_axis<"kT_I">("deg/h/g/degC"_unit, prior, "w_l, times a_I dT"),
           per_axis<"kT_S">("deg/h/g/degC"_unit, prior, "w_l, times a_S dT"));
  static constexpr Needs needs{.covariates = covariate("temperature").set()};

  template <class S>
  static void rates(const Inputs<S>& in, const S* k, RateAssembly<S>& out) {
    const Vec3T<S> per_degree =
        vec3(k).cwiseProduct(in.f_p) + vec3(k + 3).cwiseProduct(in.f_spin());
    out.omega_drift_g += per_degree * in.value_of(covariate("temperature"));
  }
};

}  // namespace drift::terms
