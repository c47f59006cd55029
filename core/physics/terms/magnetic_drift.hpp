#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// Drift from the magnetic field along the input axis of each gyro.
struct MagneticDrift {
  static constexpr std::string_view key = "magnetic_drift";
  static constexpr std::string_view title = "magnetic sensitivity";
  static constexpr std::string_view equation = "w_l,i += M_i B_I,  B_p = R_lp^T B_l";
  static constexpr std::string_view source =
      "physics.md 4, no. 18: 0.002 to 0.02 deg/h/gauss, 0.5 gauss, dip 62 deg at Harbin";
  static constexpr Subsystem subsystem = Subsystem::gyro;
  static constexpr auto params =
      per_axis<"M">("deg/h/gauss"_unit, normal(0.0, 0.01), "w_l, times the field along IA");
  static constexpr Needs needs{.covariates = covariate("field").set()};

  template <class S>
  static void rates(const Inputs<S>& in, const S* M, RateAssembly<S>& out) {
    out.omega_drift_g += vec3(M).cwiseProduct(in.vector_of(covariate("field")));
  }
};

}  // namespace drift::terms
