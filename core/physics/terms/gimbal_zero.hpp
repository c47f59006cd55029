#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// The resolvers were not zeroed where the axes are: every angle of a gimbal reads too much or too
/// little by the same. Of the outer one a case that heads otherwise looks the same.
struct GimbalZero {
  static constexpr std::string_view key = "gimbal_zero";
  static constexpr std::string_view title = "zeros of the resolvers";
  static constexpr std::string_view equation = "gimbal_k += enc_zero_k";
  static constexpr std::string_view source =
      "physics.md 3.4 gives no size of its own: as accurate as resolvers read, 1 to 20 arcsec";
  static constexpr Subsystem subsystem = Subsystem::resolvers;
  static constexpr auto params = per_gimbal<"enc_zero">(unit::arcsec, normal(0.0, 20.0),
                                                        "gimbal angle, the same at every angle");
  static constexpr Needs needs{.gimbals = true};

  template <class S>
  static void gimbals(const Inputs<S>&, const S* zero, GimbalAssembly<S>& out) {
    for (int k = 0; k < 3; ++k) out.error[k] += zero[k];
  }
};

}  // namespace drift::terms
