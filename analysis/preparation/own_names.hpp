#pragma once

#include <string>
#include <vector>

#include "core/recording/recording_format.hpp"
#include "mc/study/study.hpp"

namespace drift::preparation {

/// A message about channels in the words of the user's file: `"-acc_z"` as what [recording] columns
/// would say, and behind it which columns the channels are. Of channels whose names are words
/// (position) only what stands between quotes.
std::string in_own_names(std::string message, const RecordingFormat& format);

/// Behind the first message about each of several files, which begins with its name, that advises a
/// line of [recording]: that section is one for all, and how a file is corrected by itself. One
/// file alone: the messages stay as they are.
void correct_alone(std::vector<std::string>& messages, const mc::Study& study,
                   const std::vector<std::string>& files);

}  // namespace drift::preparation
