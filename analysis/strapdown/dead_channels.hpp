#pragma once

#include <string>
#include <vector>

#include "core/estimate/strapdown/dwells.hpp"

namespace drift::strapdown {

/// Why a recording has no dwell, and what to do: channels that are never measured for so long
/// without a break (a stuck sensor is left out before), times that do not last so long, or a case
/// that never rests.
/// longest_quiet: of the stretches that are too short (DwellSearch) [s].
std::string why_no_dwell(const Signals& signals, double static_min, double longest_quiet);

/// InputError (recording) that names an accelerometer which does not follow gravity: over four
/// rests or more it reads the same within 0.05 g while what the two others read together varies by
/// more than 0.6 g. At rest |f| is 1 g whatever the attitude, so of a live one it would have
/// changed. What the others read together also varies by twice their offset where a unit is turned
/// about the third axis alone: offsets of 100 mg (1 sigma) of both are 0.3 g in one unit of 90.
void require_live_accelerometers(const std::vector<Dwell>& dwells, const std::string& source);

}  // namespace drift::strapdown
