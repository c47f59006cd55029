#pragma once

#include <string>

#include "core/recording/recording.hpp"
#include "core/recording/recording_problems.hpp"
#include "core/recording/recording_raw.hpp"

namespace drift {

/// Reads a CSV recording (interfaces.md, section 3), streaming, whatever the locale.
///
/// UTF-8, with or without byte order mark; lines end with LF or CRLF. Lines that start with '#' are
/// comments, or facts if they hold a '='. One header row `name [unit]`, separated by commas,
/// semicolons or tabs; decimal point only. An empty cell or nan is NaN. Rows with a problem are
/// reported and left out. InputError (io) if the file cannot be read.
RawRecording read_csv(const std::string& path, Problems& problems);

/// Writes the recording as CSV: facts as comments, the shortest digits that read back as the same
/// number, in the unit of each channel; empty cells for NaN. `facts` stand for those of the
/// recording. Returns what went wrong, empty if nothing.
std::string write_csv(const Recording& recording, const Facts& facts, const std::string& path);

}  // namespace drift
