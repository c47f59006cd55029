#pragma once

#include <numbers>

#include "core/physics/memory.hpp"
#include "core/physics/term.hpp"

namespace drift::terms {

/// The pier turns about the vertical with the sun; only the resolvers see it.
struct PierAzimuth {
  static constexpr std::string_view key = "pier_azimuth";
  static constexpr std::string_view title = "daily turn of the pier";
  static constexpr std::string_view equation =
      "case turn about Up: turn_c cos(2 pi t / turn_T) + turn_s sin(2 pi t / turn_T)";
  static constexpr std::string_view source = "physics.md 4, no. 38: 1 to 5 arcsec in 24 h";
  static constexpr Subsystem subsystem = Subsystem::site;
  static constexpr Prior prior = normal(0.0, 3.0);
  static constexpr auto params =
      join(single<"turn_c">(unit::arcsec, prior, "case turn about Up, cosine"),
           single<"turn_s">(unit::arcsec, prior, "case turn about Up, sine"),
           profiled<"turn_T">(ParamKind::nonlinear, unit::hour, 24.0, {12.0, 24.0},
                              "period of the turn"));
  static constexpr Needs needs{.clock = true};

  template <class S>
  static void gimbals(const Inputs<S>& in, const S* p, GimbalAssembly<S>& out) {
    using std::cos;
    using std::sin;
    const S angle = 2.0 * std::numbers::pi * in.now().t / time_constant(p[2]);
    out.case_tilt_l[2] += p[0] * cos(angle) + p[1] * sin(angle);
  }
};

}  // namespace drift::terms
