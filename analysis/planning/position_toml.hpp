#pragma once

#include <span>
#include <string>

#include "core/config/node.hpp"
#include "core/plan/test_plan.hpp"

namespace drift::planning {

/// A position as an element of [[plan.position]]; every key is written, so that no default of the
/// file changes it.
config::Node position_node(const Position& position);

/// Positions as TOML, to be put behind the plan of a study that lists its own.
std::string positions_toml(std::span<const Position> positions);

}  // namespace drift::planning
