#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// Neighbouring gimbal axes are not quite at right angles: the chain is Rx(outer) N1 Ry(middle) N2
/// Rz(inner), N1 a small rotation about z (nonorth_1), N2 about x (nonorth_2). To first order the
/// angles then read as below; the middle one is not changed.
struct GimbalNonorthogonality {
  static constexpr std::string_view key = "gimbal_nonorthogonality";
  static constexpr std::string_view title = "gimbal axes not at right angles";
  static constexpr std::string_view equation =
      "outer += (nonorth_1 sin m - nonorth_2) / cos m,  inner += (nonorth_2 sin m - nonorth_1) / "
      "cos m";
  static constexpr std::string_view source = "physics.md 4, no. 42: 5 to 30 arcsec";
  static constexpr Subsystem subsystem = Subsystem::resolvers;
  static constexpr auto params = join(
      single<"nonorth_1">(unit::arcsec, normal(0.0, 15.0), "gimbal angles, outer to middle axis"),
      single<"nonorth_2">(unit::arcsec, normal(0.0, 15.0), "gimbal angles, middle to inner axis"));
  static constexpr Needs needs{.gimbals = true};

  template <class S>
  static void gimbals(const Inputs<S>& in, const S* nu, GimbalAssembly<S>& out) {
    using std::cos;
    using std::sin;
    const S s = sin(in.around->gimbal[1]), c = cos(in.around->gimbal[1]);
    out.error[0] += (nu[0] * s - nu[1]) / c;
    out.error[2] += (nu[1] * s - nu[0]) / c;
  }
};

}  // namespace drift::terms
