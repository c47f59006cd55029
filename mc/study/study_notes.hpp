#pragma once

#include <string>

#include "mc/study/study.hpp"

namespace drift::mc {

/// A note, one line, for each `--set` of a key that has no effect in the study (no_effect()).
/// Nothing of a key whose section a sweep changes.
std::string idle_settings_text(const Study& study);

/// A note, one line, where a sweep changes the sample interval and no noise of [readout]: that is
/// declared for one sample, of whatever length, so the points compare noise. Empty otherwise.
std::string swept_sample_text(const Study& study);

}  // namespace drift::mc
