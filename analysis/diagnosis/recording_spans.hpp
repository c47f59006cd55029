#pragma once

#include <vector>

#include "analysis/diagnosis/findings/where.hpp"
#include "core/recording/recording.hpp"
#include "mc/study/study.hpp"

namespace drift::diagnosis {

/// Of several recordings: where each lies in the timeline of the diagnosis, by file name, or by
/// whole path where two files have one name. Empty of one recording. recordings: as diagnosed.
std::vector<RecordingSpan> recording_spans(const mc::Study& study,
                                           const std::vector<Recording>& recordings);

}  // namespace drift::diagnosis
