#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/recording/own/header.hpp"
#include "core/recording/recording_problems.hpp"
#include "core/recording/recording_raw.hpp"

namespace drift {

/// What becomes of one column of a file.
struct ColumnUse {
  enum class Role {
    ignored,
    time,
    counter,
    date,  ///< of the times of day in the column of time
    position,
    phase,
    sensor,     ///< a cell that is no number is an error
    covariate,  ///< a cell that is no number is not measured
  };
  Role role = Role::covariate;
  std::string channel;              ///< the program's name for it
  std::optional<std::string> unit;  ///< as the study file or the file says
  double sign = 1.0;
};

/// Tells the columns of a file apart. What the format names and the file lacks, headers that look
/// like a slip of the pen, and units that contradict each other are problems; names that had to be
/// changed are remarks of `raw`.
std::vector<ColumnUse> uses_of_columns(const std::vector<HeaderCell>& header,
                                       const RecordingFormat& format, RecordingKind kind,
                                       Problems& problems, RawRecording& raw);

/// The columns under the program's names, with the time that the format gives instead of a column.
/// `uses` is parallel to the columns.
RawRecording with_channels(RawRecording raw, const std::vector<ColumnUse>& uses,
                           const RecordingFormat& format, Problems& problems);

}  // namespace drift
