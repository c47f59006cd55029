#pragma once

#include <string>
#include <vector>

#include "analysis/preparation/input_thresholds.hpp"
#include "core/recording/recording.hpp"
#include "mc/study/study.hpp"

namespace drift::preparation {

/// Recordings ready for a diagnosis, and what was done to them.
struct Prepared {
  mc::Study study;  ///< the plan's sample interval and the accelerometer noise fit the recordings
  std::vector<Recording> recordings;
  std::vector<std::string>
      remarks;  ///< what was left out or changed, and what the plan cannot give
};

/// Looks recordings over before they are diagnosed.
///
/// Refused, all mistakes at once (InputError, recording): positions that the plan does not have or
/// whose attitude is not the plan's, gaps in which the command changed (all said by lay_out()),
/// samples farther apart than the plan's or not a whole part of them, nothing measured, without
/// recorded commands a platform that moves by another law than the plan's (check_plan()). Remarked
/// only: positions of the plan that no recording holds, one position (nothing can be held out),
/// channels absent or empty, bursts of missing samples, dwells and commands that are not the
/// plan's. Bridged and remarked: rows missing within a position (fill_gaps()). Left out and
/// remarked: a channel, or a stretch of it, that stands at one and the same value for at least 20
/// samples and 20 times as long as it usually does: a stuck sensor. Its samples become NaN. Reduced
/// (reduced(), core/sim/reduce.hpp): samples closer than the plan's, and recordings of more than
/// `most_rows` rows.
Prepared prepare(const mc::Study& study, const std::vector<Recording>& recordings,
                 std::size_t most_rows = RecordingLimits::most_rows);

}  // namespace drift::preparation
