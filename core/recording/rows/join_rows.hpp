#pragma once

#include "core/recording/recording.hpp"
#include "core/recording/rows/row_spacing.hpp"

namespace drift {

/// How far rows may be joined.
struct JoinLimits {
  double length = 1.0;          ///< of a joined row [samples of the plan]
  std::vector<double> planned;  ///< at each row the plan's sample, whose noise is declared [s]
};

/// The recording with its fine rows joined, stretch by stretch, to rows of nearly equal length; a
/// stretch ends where position, phase, command (by more than 1e-9 rad/s) or the rate of the case
/// heading changes. Rows that are long already (0.7 of a joined row) are left as they are.
/// `recording.begins` must say when each row begins; `spacing` is of its rows.
///
/// Accelerometers: bridged_mean(), and `samples` says how many samples of the plan it is worth: as
/// many as it lasts, for a row is the mean over its own interval. Where the platform slews a
/// joined row turns by 0.6 rad at most, so that holes can be bridged. Gimbal angles, case heading
/// and the loop's belief: as read at the end. Covariates: what they are there (line_at_end()).
/// Commands: mean weighted by time.
Recording joined_rows(const Recording& recording, const RowSpacing& spacing,
                      const JoinLimits& limits);

}  // namespace drift
