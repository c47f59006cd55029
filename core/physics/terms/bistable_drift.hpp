#pragma once

#include "core/physics/term.hpp"

namespace drift::terms {

/// Drift that jumps between two levels +-B (bearing retainer): telegraph noise, one level per
/// sample interval, each gyro for itself. A truth realises it; a filter cannot know when it jumps,
/// so it gives D_F the variance of the jumps (core/physics/stochastic.hpp).
struct BistableDrift {
  static constexpr std::string_view key = "bistable_drift";
  static constexpr std::string_view title = "bistable drift, random between two levels";
  static constexpr std::string_view equation =
      "w_l,i += +-B_i, telegraph noise; a level lasts B_dwell on average";
  static constexpr std::string_view source =
      "physics.md 4, no. 7: 0.01 to 0.05 deg/h, minutes to hours";
  static constexpr Subsystem subsystem = Subsystem::gyro;
  static constexpr auto params = join(
      per_axis<"B">(unit::deg_per_h, uniform(0.01, 0.05), "w_l, half the distance of the levels",
                    ParamKind::noise),
      single<"B_dwell">(unit::minute, fixed(40.0), "mean duration of a level", ParamKind::noise));
};

}  // namespace drift::terms
