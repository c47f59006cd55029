#pragma once

#include <string>
#include <vector>

#include "core/recording/recording.hpp"

namespace drift::preparation {

/// Of every two recordings of which one begins in the position in which the other ends, within two
/// samples by one clock: a remark that they may be one that was cut, and what to do. The platform
/// may have been caged as fast between them: it is asked, not refused.
std::vector<std::string> parts_of_one(const std::vector<Recording>& recordings);

}  // namespace drift::preparation
