#pragma once

#include "mc/study/study.hpp"

namespace drift::mc {

/// InputError (config) if the library holds other own terms than those that the study was read with
/// (Study::own_terms): another study has been read since, and its equations stand in the places of
/// this one's. Of a study that was made by hand nothing is known.
void require_own_terms(const Study& study);

}  // namespace drift::mc
