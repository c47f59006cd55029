#pragma once

#include <string>

#include "core/recording/recording_format.hpp"

namespace drift::preparation {

/// A message about channels in the words of the user's file: `"-acc_z"` as what [recording] columns
/// would say, and behind it which columns the channels are.
std::string in_own_names(std::string message, const RecordingFormat& format);

}  // namespace drift::preparation
