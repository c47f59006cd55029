#pragma once

#include "core/base/dual.hpp"
#include "core/physics/term.hpp"

namespace drift::terms {

/// Errors of the resolvers that repeat with the angle: eccentricity (once and twice per turn) and
/// the electrical cycle (enc_n times per turn).
struct EncoderHarmonics {
  static constexpr std::string_view key = "encoder_harmonics";
  static constexpr std::string_view title = "harmonic errors of the resolvers";
  static constexpr std::string_view equation =
      "gimbal_k += sum over n = 1, 2, enc_n of enc_sn_k sin(n theta_k) + enc_cn_k cos(n theta_k)";
  static constexpr std::string_view source = "physics.md 4, no. 41: 2 to 20 arcsec";
  static constexpr Subsystem subsystem = Subsystem::resolvers;
  static constexpr Prior prior = normal(0.0, 5.0);
  static constexpr auto params =
      join(per_gimbal<"enc_s1">(unit::arcsec, prior, "gimbal angle, sine once per turn"),
           per_gimbal<"enc_c1">(unit::arcsec, prior, "gimbal angle, cosine once per turn"),
           per_gimbal<"enc_s2">(unit::arcsec, prior, "gimbal angle, sine twice per turn"),
           per_gimbal<"enc_c2">(unit::arcsec, prior, "gimbal angle, cosine twice per turn"),
           per_gimbal<"enc_sn">(unit::arcsec, prior, "gimbal angle, sine enc_n times per turn"),
           per_gimbal<"enc_cn">(unit::arcsec, prior, "gimbal angle, cosine enc_n times per turn"),
           profiled<"enc_n">(ParamKind::discrete, unit::one, 16.0, {4.0, 8.0, 16.0, 32.0},
                             "electrical cycles per turn"));
  static constexpr Needs needs{.gimbals = true};

  template <class S>
  static void gimbals(const Inputs<S>& in, const S* p, GimbalAssembly<S>& out) {
    using std::cos;
    using std::sin;
    const double cycles[3] = {1.0, 2.0, value(p[18])};
    for (int h = 0; h < 3; ++h)
      for (int k = 0; k < 3; ++k) {
        const S angle = cycles[h] * in.around->gimbal[k];
        out.error[k] += p[6 * h + k] * sin(angle) + p[6 * h + 3 + k] * cos(angle);
      }
  }
};

}  // namespace drift::terms
