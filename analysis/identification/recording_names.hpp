#pragma once

#include <string>
#include <vector>

#include "core/recording/recording.hpp"

namespace drift::identification {

/// How each of several recordings is called: by its file name, or by its whole path where two files
/// have one name; "recording 2" of one that is in no file. Empty of one recording, which needs no
/// name.
std::vector<std::string> recording_names(const std::vector<Recording>& recordings);

}  // namespace drift::identification
