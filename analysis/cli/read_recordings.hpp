#pragma once

#include <string>
#include <vector>

#include "core/recording/recording.hpp"
#include "mc/study/study.hpp"

namespace drift::cli {

/// Reads the recordings of a command line and prints the quality card of each. InputError
/// (recording).
std::vector<Recording> read_recordings(const mc::Study& study,
                                       const std::vector<std::string>& paths);

}  // namespace drift::cli
