#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// Single samples that are wrong: missing or extra pulses, clock jumps. A truth makes them; a
/// filter leaves out what lies outside its gate (EKF: of each innovation; batch: of each residual).
struct Outliers {
  static constexpr std::string_view key = "outliers";
  static constexpr std::string_view title = "outliers";
  static constexpr std::string_view equation =
      "with probability outlier_rate, a sample += normal(0, outlier_size) times its noise";
  static constexpr std::string_view source = "physics.md 4, no. 50";
  static constexpr Subsystem subsystem = Subsystem::recording;
  static constexpr auto params =
      join(single<"outlier_rate">(unit::one, fixed(0.002), "probability that a sample is wrong",
                                  ParamKind::noise),
           single<"outlier_size">(unit::one, fixed(30.0),
                                  "size of an outlier, in sigmas of the noise", ParamKind::noise),
           single<"outlier_gate">(unit::one, fixed(5.0), "gate of a filter, in sigmas",
                                  ParamKind::noise));
};

}  // namespace drift::terms
