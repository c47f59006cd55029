#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// The accelerometer block yields to gravity: it turns about each platform axis in proportion to
/// the specific force along the next one. Accelerometers and resolvers then disagree by products of
/// two specific forces, as with K_pp and K_oo.
struct Sag {
  static constexpr std::string_view key = "sag";
  static constexpr std::string_view title = "compliance of the accelerometer block";
  static constexpr std::string_view equation =
      "f -> f + f x delta,  delta = (C_sag_x a_y, C_sag_y a_z, C_sag_z a_x)";
  static constexpr std::string_view source = "physics.md 4, no. 16: 1 to 10 arcsec/g";
  static constexpr Subsystem subsystem = Subsystem::structure;
  static constexpr auto params = per_axis<"C_sag">("arcsec/g"_unit, normal(0.0, 5.0),
                                                   "accelerometer output, tilt of the block");

  template <class S>
  static void readout(const Inputs<S>& in, const S* sag, ReadoutAssembly<S>& out) {
    const Vec3T<S> delta_p(sag[0] * in.f_p[1], sag[1] * in.f_p[2], sag[2] * in.f_p[0]);
    out.acc += in.f_p.cross(delta_p);
  }
};

}  // namespace drift::terms
