#pragma once

#include <string>
#include <string_view>

#include "analysis/report/page/table.hpp"

namespace drift::cli {

/// A text for a terminal with its verdicts coloured: green where model and data agree, red where
/// they do not, yellow where something is named. Colours take no columns.
std::string with_coloured_verdicts(std::string_view text);

/// An answer with its judgement, what stands before the first colon, in the colour of its tone.
std::string with_coloured_judgement(std::string_view text, report::Tone tone);

}  // namespace drift::cli
