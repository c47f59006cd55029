#pragma once

#include "core/physics/gimbals.hpp"
#include "core/physics/term.hpp"

namespace drift::terms {

/// The resolvers are sampled a little after the time that the recording says. The rates of the
/// gimbals are those of the platform as it drifts: some deg/h beside the Earth's 15 would make the
/// skew wrong by as large a part.
struct TimingSkew {
  static constexpr std::string_view key = "timing_skew";
  static constexpr std::string_view title = "timing skew of the resolvers";
  static constexpr std::string_view equation = "gimbal_k += skew theta_k'";
  static constexpr std::string_view source =
      "physics.md 4, no. 44: 0.1 s is 1.5 arcsec in free drift, 10 ms is 18 arcsec at 0.5 deg/s";
  static constexpr Subsystem subsystem = Subsystem::resolvers;
  static constexpr auto params =
      single<"skew">("ms"_unit, normal(0.0, 50.0), "gimbal angles, times their rates");
  static constexpr Needs needs{.gimbals = true, .own_rate = true};

  template <class S>
  static void gimbals(const Inputs<S>& in, const S* skew, GimbalAssembly<S>& out) {
    out.error += gimbal_rates(in.around->gimbal, in.omega_cp_p_with_drift()) * skew[0];
  }
};

}  // namespace drift::terms
