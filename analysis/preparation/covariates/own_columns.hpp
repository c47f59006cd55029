#pragma once

#include <string>
#include <vector>

#include "core/recording/recording.hpp"

namespace drift::preparation {

/// What is wrong with the columns that own terms follow, as with those of the library: a
/// temperature that is none of a test, be it one of its own or a difference [degC, K, degF], and a
/// column that is another quantity in another recording. That one of several gives no unit is a
/// remark.
std::vector<std::string> mistakes_of_own_columns(const std::vector<Recording>& recordings,
                                                 std::vector<std::string>& remarks);

}  // namespace drift::preparation
