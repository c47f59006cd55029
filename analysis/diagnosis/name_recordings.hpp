#pragma once

#include <vector>

#include "analysis/diagnosis/diagnosis.hpp"
#include "mc/study/study.hpp"

namespace drift::diagnosis {

/// Of several recordings: where each lies in the timeline of the diagnosis (Where::recordings), and
/// their names in the folds that hold one out. Nothing is done for one recording. recordings: as
/// diagnosed.
void name_recordings(const mc::Study& study, const std::vector<Recording>& recordings,
                     Diagnosis& diagnosis);

}  // namespace drift::diagnosis
