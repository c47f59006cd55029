#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// Drift from compliance of the float, second order in specific force.
///
/// In a 1 g laboratory a_I^2 + a_O^2 + a_S^2 = 1, so D_F and the common part of D_II, D_OO, D_SS
/// are seen only as a sum (physics.md 2.4).
struct G2Drift {
  static constexpr std::string_view key = "g2_drift";
  static constexpr std::string_view title = "g^2-sensitive drift (compliance)";
  static constexpr std::string_view equation =
      "w_l,i += D_II a_I^2 + D_OO a_O^2 + D_SS a_S^2 + D_IO a_I a_O + D_IS a_I a_S + D_OS a_O a_S";
  static constexpr std::string_view source = "IEEE 517 gyro model equation; physics.md 2.1";
  static constexpr Subsystem subsystem = Subsystem::gyro;
  static constexpr Prior prior = normal(0.0, 0.1);
  static constexpr auto params =
      join(per_axis<"D_II">(unit::deg_per_h_per_g2, prior, "w_l, times a_I^2"),
           per_axis<"D_OO">(unit::deg_per_h_per_g2, prior, "w_l, times a_O^2"),
           per_axis<"D_SS">(unit::deg_per_h_per_g2, prior, "w_l, times a_S^2"),
           per_axis<"D_IO">(unit::deg_per_h_per_g2, prior, "w_l, times a_I a_O"),
           per_axis<"D_IS">(unit::deg_per_h_per_g2, prior, "w_l, times a_I a_S"),
           per_axis<"D_OS">(unit::deg_per_h_per_g2, prior, "w_l, times a_O a_S"));

  template <class S>
  static void rates(const Inputs<S>& in, const S* D, RateAssembly<S>& out) {
    const Vec3T<S> o = in.f_output(), s = in.f_spin();
    const auto add = [&](const S* coefficient, const Vec3T<S>& a, const Vec3T<S>& b) {
      out.omega_drift_g += vec3(coefficient).cwiseProduct(a).cwiseProduct(b);
    };
    add(D, in.f_p, in.f_p);
    add(D + 3, o, o);
    add(D + 6, s, s);
    add(D + 9, in.f_p, o);
    add(D + 12, in.f_p, s);
    add(D + 15, o, s);
  }
};

}  // namespace drift::terms
