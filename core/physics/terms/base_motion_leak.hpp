#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// The platform follows a small part of the motion of its case: finite isolation, drag of cables.
struct BaseMotionLeak {
  static constexpr std::string_view key = "base_motion_leak";
  static constexpr std::string_view title = "base motion that leaks through";
  static constexpr std::string_view equation = "w_ip,i += kappa_i w_ic,i";
  static constexpr std::string_view source = "physics.md 1.5 and 4, no. 32: 1 to 100 ppm";
  static constexpr Subsystem subsystem = Subsystem::servo;
  static constexpr auto params =
      per_axis<"kappa">(unit::ppm, normal(0.0, 100.0), "platform rate, times w_ic");

  template <class S>
  static void rates(const Inputs<S>& in, const S* kappa, RateAssembly<S>& out) {
    out.omega_ip_p += vec3(kappa).cwiseProduct(in.omega_ic_p);
  }
};

}  // namespace drift::terms
