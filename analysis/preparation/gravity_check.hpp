#pragma once

#include <string>

#include "core/recording/recording.hpp"
#include "mc/study/study.hpp"

namespace drift::preparation {

/// What is wrong with accelerometers of a platform that together do not read 1 g in its dwells:
/// which of them is in another unit or of another scale, and the unit in which they would; empty
/// where they do, or where they were not all measured.
std::string other_than_one_g(const mc::Study& study, const Recording& recording);

}  // namespace drift::preparation
