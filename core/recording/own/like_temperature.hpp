#pragma once

#include <string>
#include <vector>

#include "core/recording/own/header.hpp"

namespace drift {

/// Whether a column says that it is a temperature: by its unit, or, where that is none that is
/// known, by its name in some language.
bool looks_like_temperature(const HeaderCell& cell);

/// What a reader is told whose temperatures no channel is: which they are, and the line to write.
std::string unmapped_temperature_remark(const std::vector<HeaderCell>& cells);

}  // namespace drift
