#pragma once

#include <string>

#include "core/recording/recording.hpp"
#include "mc/study/study.hpp"

namespace drift::preparation {

/// The gimbals say when a command changed; of the wrong sign, exchanged or in another unit they say
/// it nowhere, and rows seem to be missing. What is wrong with them, and the line that mends it:
/// where, taken otherwise in one way alone, no row is missing that cannot be made up for. Empty
/// otherwise.
std::string gimbals_behind_gaps(const Recording& recording, const mc::Study& study);

}  // namespace drift::preparation
