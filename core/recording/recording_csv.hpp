#pragma once

#include <string>

#include "core/recording/recording.hpp"
#include "core/recording/recording_problems.hpp"
#include "core/recording/recording_raw.hpp"

namespace drift {

/// Reads a CSV recording (core/docs/recording.md), streaming, whatever the locale.
///
/// UTF-8, UTF-16 or Windows-1252; lines end with LF or CRLF. Lines that start with '#' are
/// comments, or facts if they hold a '='. One header row `name [unit]`, which lines may stand above
/// and a row of units below, separated by commas, semicolons, tabs or blanks; decimal point or
/// comma. An empty cell or nan is NaN. Rows with a problem are reported and left out; a last row
/// that is cut off is left out with a remark. InputError (io) if the file cannot be read.
RawRecording read_csv(const std::string& path, const RecordingFormat& format, RecordingKind kind,
                      Problems& problems, const ReadProgress& progress = {});

/// Writes the recording as CSV: facts as comments, the shortest digits that read back as the same
/// number, in the unit of each channel; empty cells for NaN. `facts` stand for those of the
/// recording. Returns what went wrong, empty if nothing.
std::string write_csv(const Recording& recording, const Facts& facts, const std::string& path);

}  // namespace drift
