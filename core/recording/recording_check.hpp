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

/// Whether a step back in time [s] may be that of a clock of 24 hours: over midnight within an
/// hour.
bool begins_again_at_midnight(double before, double after);

}  // namespace drift
