#pragma once

#include <optional>
#include <vector>

#include "core/recording/recording.hpp"
#include "mc/study/study.hpp"

namespace drift::identification {

/// A position that a recording shows turned about Up against the plan of the study.
struct TurnedPosition {
  int position = 0;   ///< from 0
  double turn = 0.0;  ///< right-handed about Up, from North toward West [rad]
};

/// The headings that a recording is of, if they are not those of the plan.
struct HeadingDoubt {
  std::vector<TurnedPosition> turned;  ///< at least one
  bool all_alike = false;              ///< every position of the plan, by one turn
  bool recorded = false;  ///< a heading of the case was recorded, too, and is as wrong as the plan
  /// The positions of the plan as the recording has them: axes and, where gimbals were recorded,
  /// case_heading.
  std::vector<Position> positions;
  double chi2_per_dof_before = 0.0, chi2_per_dof_after = 0.0;  ///< of the filter's fit
  /// That the plan is right all the same, where one study of 1000 has wrong headings and one set
  /// of turns is as likely as another.
  double chance = 1.0;
  double chance_after = 1.0;  ///< that a right model's chi-square is as far above 1 as that

  /// As LatitudeDoubt::alone().
  bool alone() const;
};

/// Asks whether positions headed otherwise than the plan says. Neither gimbals nor accelerometers
/// show it: a case at another heading carries platform and gimbals along. The Earth does: it turns
/// the platform about North. Where North was in each dwell gives the turns to be tried, multiples
/// of 45 deg that `axes` can say, alike for all positions or one for each caging; the filter's fit
/// decides.
///
/// Given where chance leaves less than it does a wrong hemisphere (FitLimits::mirrored) and the
/// turns take away 90 % of what the filter leaves above its degrees of freedom. recordings: made
/// ready (prepare()). Costs no fit where every position heads as planned.
std::optional<HeadingDoubt> heading_doubt(const mc::Study& study,
                                          const std::vector<Recording>& recordings,
                                          const FilterSpec& filter);

}  // namespace drift::identification
