#pragma once

#include <vector>

#include "core/config/section.hpp"
#include "core/plan/attitude/axis_turn.hpp"

namespace drift {

/// Reads `turn` of a position: "10 deg about y", or a list of such turns in the order in which they
/// are done. None where it is left out.
std::vector<AxisTurn> read_turns(config::Section& section);

}  // namespace drift
