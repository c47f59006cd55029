#pragma once

#include <string>
#include <vector>

#include "analysis/preparation/noise_card.hpp"
#include "core/recording/recording.hpp"
#include "mc/study/study.hpp"

namespace drift::preparation {

/// What is wrong with accelerometers of a platform that together do not read 1 g in its dwells:
/// which of them is in another unit or of another scale, and the unit in which they would; empty
/// where they do, or where they were not all measured.
std::string other_than_one_g(const mc::Study& study, const Recording& recording);

/// The same of sensors on a case that rests in these rows: which accelerometers are in another unit
/// than the others, where the specific force depends on the attitude by a factor. What is less than
/// a unit is scale, and estimated.
std::string accelerometers_in_another_unit(const Recording& recording,
                                           const std::vector<RestingRows>& rests);

}  // namespace drift::preparation
