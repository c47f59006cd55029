#pragma once

#include <string>

#include "mc/study/study.hpp"

namespace drift::mc {

/// A note, one line, for each `--set` of a key that has no effect in the study (no_effect()).
/// Nothing of a key whose section a sweep changes.
std::string idle_settings_text(const Study& study);

}  // namespace drift::mc
