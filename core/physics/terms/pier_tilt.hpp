#pragma once

#include <numbers>

#include "core/physics/memory.hpp"
#include "core/physics/term.hpp"

namespace drift::terms {

/// The pier tilts with the sun, and the case with it; the platform does not follow, so the
/// resolvers see it.
struct PierTilt {
  static constexpr std::string_view key = "pier_tilt";
  static constexpr std::string_view title = "daily tilt of the pier";
  static constexpr std::string_view equation =
      "case tilt about North and West: tilt_c cos(2 pi t / tilt_T) + tilt_s sin(2 pi t / tilt_T)";
  static constexpr std::string_view source =
      "physics.md 4, no. 37: 5 to 10 arcsec in 24 h; NASA TN D-3683";
  static constexpr Subsystem subsystem = Subsystem::site;
  static constexpr Prior prior = normal(0.0, 5.0);
  static constexpr auto params =
      join(single<"tilt_c_n">(unit::arcsec, prior, "case tilt about North, cosine"),
           single<"tilt_s_n">(unit::arcsec, prior, "case tilt about North, sine"),
           single<"tilt_c_w">(unit::arcsec, prior, "case tilt about West, cosine"),
           single<"tilt_s_w">(unit::arcsec, prior, "case tilt about West, sine"),
           profiled<"tilt_T">(ParamKind::nonlinear, unit::hour, 24.0, {12.0, 24.0},
                              "period of the tilt"));
  static constexpr Needs needs{.clock = true};

  template <class S>
  static void gimbals(const Inputs<S>& in, const S* p, GimbalAssembly<S>& out) {
    using std::cos;
    using std::sin;
    const S angle = 2.0 * std::numbers::pi * in.now().t / time_constant(p[4]);
    const S c = cos(angle), s = sin(angle);
    out.case_tilt_l[0] += p[0] * c + p[1] * s;
    out.case_tilt_l[1] += p[2] * c + p[3] * s;
  }
};

}  // namespace drift::terms
