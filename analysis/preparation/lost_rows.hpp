#pragma once

#include <string>
#include <vector>

#include "core/recording/recording.hpp"
#include "core/recording/rows/row_spacing.hpp"
#include "mc/study/study.hpp"

namespace drift::preparation {

/// A recording whose rows know when they begin.
struct Spaced {
  Recording recording;  ///< `begins` is set
  RowSpacing spacing;   ///< of its rows
};

/// Says of every row when it begins, and sees to the rows that are missing.
///
/// A row begins at the row before it. The first row of a caged position begins one usual step
/// earlier, or with the dwell of the plan where that begins when the position before ended, or a
/// few rows are missing; where that step is uncertain by so much that Earth rate would show in the
/// accelerometers (jitter), its accelerometers are not measured.
///
/// Behind missing rows a row begins at the last one that is there, with the command held, and its
/// accelerometers are not measured: a logger that lost rows gives the mean over its own sample, one
/// that was late the mean since the row before, and nothing in the recording says which. The gimbal
/// angles hold either way. Where the command changed while rows were missing, the gimbal angles
/// before and behind say when: one row without measurements is put there, on the grid of the rows
/// around. Where they cannot say it (no angles; the way from one dwell to the next is missing
/// altogether; no time on the grid fits) the gap is refused, a message each in `wrong`.
Spaced with_begins(const Recording& recording, const mc::Study& study,
                   std::vector<std::string>& remarks, std::vector<std::string>& wrong);

/// Rows are missing in front of one to which the attitude is carried along, or at the begin of a
/// caged position that follows the one before at once.
bool rows_missing(const Recording& recording, const TestPlan& plan);

}  // namespace drift::preparation
