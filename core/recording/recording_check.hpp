#pragma once

#include "core/recording/recording.hpp"
#include "core/recording/recording_problems.hpp"
#include "core/recording/recording_raw.hpp"

namespace drift {

/// Checks what is common to all formats and converts to internal units: names, units and
/// dimensions, the columns its kind needs, equal lengths, time strictly increasing, positions and
/// phases that make sense, no infinity. What is wrong is added to `problems`; the recording
/// returned is only meaningful if there are none.
///
/// gravity: of the site [m/s^2], for strapdown accelerations given in m/s^2; they keep that unit
/// for writing, its size being 1/gravity in g.
Recording checked_recording(RawRecording raw, RecordingKind kind, double gravity,
                            Problems& problems);

/// Adds a problem for every column that the kind needs and is not there, alone or as one of three.
/// not_counted: why positions could not be counted where no column has them.
void check_columns(const Recording& recording, RecordingKind kind, const std::string& not_counted,
                   Problems& problems);

/// Adds a problem for a value that is infinite, or that of a command that is missing.
void check_value(const Recording& recording, const Channel& channel, std::size_t row,
                 RecordingKind kind, Problems& problems);

/// The value of a row that is farther from zero than `most` [SI] is. fix: empty before the first of
/// its channel; rows with the same one are one message.
void add_unreasonable(const Recording& recording, const Channel& channel, std::size_t row,
                      double most, std::string& fix, Problems& problems);

}  // namespace drift
