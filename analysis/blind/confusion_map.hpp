#pragma once

#include <string>

#include "analysis/blind/summary.hpp"

namespace drift::blind {

/// What was hidden against what it was called as an SVG document: cells darker with the share of their row.
std::string svg_of(const Confusion& confusion);

}  // namespace drift::blind
