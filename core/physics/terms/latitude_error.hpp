#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// The site's latitude is wrong: the local axes turn otherwise than thought, which looks like a
/// rate of the platform. (The part that eq. (5) senses, E times it, is below 1e-6 deg/h and left
/// out.)
struct LatitudeError {
  static constexpr std::string_view key = "latitude_error";
  static constexpr std::string_view title = "error of the latitude";
  static constexpr std::string_view equation =
      "w_ip += -R_lp^T d_lat Omega (-sin lat, 0, cos lat);  true latitude = lat + d_lat";
  static constexpr std::string_view source = "physics.md 4, no. 34: 10 arcsec is 7e-4 deg/h";
  static constexpr Subsystem subsystem = Subsystem::site;
  static constexpr auto params =
      single<"d_lat">(unit::arcsec, normal(0.0, 20.0), "apparent platform rate");
  static constexpr Needs needs{.clock = true, .attitude = true};

  template <class S>
  static void rates(const Inputs<S>& in, const S* d_lat, RateAssembly<S>& out) {
    const Vec3& earth = in.now().omega_ie_l;
    const Vec3T<S> d_omega_l(-earth.z() * d_lat[0], S(0.0), earth.x() * d_lat[0]);
    out.omega_ip_p -= in.to_platform(d_omega_l);
  }
};

}  // namespace drift::terms
