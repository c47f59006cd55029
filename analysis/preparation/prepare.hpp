#pragma once

#include <string>
#include <vector>

#include "analysis/preparation/covariates/unknown_rows.hpp"
#include "analysis/preparation/input_thresholds.hpp"
#include "core/recording/recording.hpp"
#include "mc/study/study.hpp"

namespace drift::preparation {

/// Recordings ready for an estimate or a diagnosis, and what was done to them.
struct Prepared {
  mc::Study study;  ///< the plan's sample interval and the accelerometer noise fit the recordings
  std::vector<Recording> recordings;
  std::vector<std::string>
      remarks;  ///< what was left out or changed, and what the plan cannot give
  std::vector<int> absent_positions = {};    ///< numbers of the plan's that no recording holds
  std::vector<UnusedCovariate> unused = {};  ///< recorded, and taken as not recorded
  std::string off_zero = {};  ///< of the first gimbal, or of the heading, that is a constant off
};

/// Looks recordings over before parameters are estimated from them or they are diagnosed:
/// `identify` and `diagnose` accept the same files.
///
/// Refused first: a study whose own terms are in the library no more (InputError, config:
/// require_own_terms()); none at all, and those that were made otherwise than files are read
/// (InputError, recording: require_recordings()). Refused then, all mistakes at once: positions
/// that the plan does not have or whose attitude is not the plan's, times in another unit
/// (other_unit_of_time()), a clock that leapt within a position (clock_leaps_text()), gaps in which
/// the command changed and the gimbals do not tell when (with_begins()), nothing measured, without
/// recorded commands a platform that moves by another law than the plan's (check_plan()); evenly
/// spaced rows farther apart than the plan's samples or not a whole part of them, whatever the rows
/// of other recordings are (take_rows()). Remarked only: positions of the plan that no recording
/// holds, one position (nothing can be held out), channels absent or empty, bursts of missing
/// samples, missing rows, dwells and commands that are not the plan's. Left out and remarked: a
/// channel, or a stretch of it, that stands at one and the same value for at least 20 samples and
/// 20 times as long as it usually does, or longer than chance has it: a stuck sensor
/// (stuck_rows()). And, of rows that are joined, single readings far from those around
/// (raw_spikes()). Such samples become NaN.
///
/// Rows may lie at any distance from each other, in one recording and in several. Rows that are
/// evenly spaced throughout, of positions that have one sample in the plan, stay as they are, or a
/// whole number of them becomes one (reduced()). Others have each their own interval
/// (with_begins()), and fine ones are joined (joined_rows()) to samples of their position in the
/// plan, or coarser ones above `most_rows` rows. Declared is the noise of the mean over a sample of
/// the plan: `samples` of the recordings says how many a row is worth.
///
/// Columns that terms may follow have straight lines where no reading is missing that is usual
/// (bridge_covariates()); what hangs on them elsewhere is left out (leave_out_unknown()). Of a
/// thermometer that reads in steps the temperature is what the steps show (SmoothReading).
Prepared prepare(const mc::Study& study, const std::vector<Recording>& recordings,
                 std::size_t most_rows = RecordingLimits::most_rows,
                 Following following = Following::filters);

}  // namespace drift::preparation
