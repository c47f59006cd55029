#pragma once

#include <string>

#include "core/recording/recording.hpp"
#include "core/recording/recording_problems.hpp"
#include "core/recording/recording_raw.hpp"

namespace drift {

/// What of a recording, with these facts, is not in the file just written, judged by what reads
/// back from it and by the problems of reading it; empty if all of it is there, bit for bit.
std::string lost_in_writing(const Recording& recording, const Facts& facts,
                            const RawRecording& back, const Problems& problems);

}  // namespace drift
