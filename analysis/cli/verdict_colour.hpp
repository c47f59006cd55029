#pragma once

#include <string>
#include <string_view>

namespace drift::cli {

/// A text for a terminal with its verdicts coloured: green where model and data agree, red where
/// they do not, yellow where something is named. Colours take no columns.
std::string with_coloured_verdicts(std::string_view text);

}  // namespace drift::cli
