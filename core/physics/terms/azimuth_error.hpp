#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// The direction taken for North lies a small angle toward West of it: Earth rate then has a part
/// toward East in the axes of the test.
struct AzimuthError {
  static constexpr std::string_view key = "azimuth_error";
  static constexpr std::string_view title = "error of the azimuth reference";
  static constexpr std::string_view equation = "w_ip += R_lp^T d_az Omega cos(lat) (0, 1, 0)";
  static constexpr std::string_view source = "physics.md 4, no. 35: 60 arcsec is 0.003 deg/h";
  static constexpr Subsystem subsystem = Subsystem::site;
  static constexpr auto params =
      single<"d_az">(unit::arcsec, normal(0.0, 60.0), "apparent platform rate");
  static constexpr Needs needs{.clock = true, .attitude = true};

  template <class S>
  static void rates(const Inputs<S>& in, const S* d_az, RateAssembly<S>& out) {
    const Vec3T<S> d_omega_l(S(0.0), -in.now().omega_ie_l.x() * d_az[0], S(0.0));
    out.omega_ip_p -= in.to_platform(d_omega_l);
  }
};

}  // namespace drift::terms
