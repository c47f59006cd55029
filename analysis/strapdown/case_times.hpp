#pragma once

#include "analysis/diagnosis/findings/diagnosis.hpp"
#include "analysis/strapdown/case_identify.hpp"

namespace drift::strapdown {

/// Asks whether the clock of the recording may stand in place of what was found. Times that are all
/// too long by one factor let the gyros turn the case by as much more, on all axes alike, and leave
/// what they read at rest: scale factors that are others in turns than at rest, which bent scale
/// factors of three gyros are, all alike. Compared as times_instead() does it, on the rows as they
/// were laid out (retimed()), and under noise that was found to drive the gyros; where it is told,
/// no cause is named alone.
void take_times(diagnosis::Diagnosis& d, const CaseIdentification& id, const FilterSpec& nominal);

}  // namespace drift::strapdown
