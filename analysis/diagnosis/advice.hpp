#pragma once

#include <string>
#include <vector>

#include "core/config/node.hpp"
#include "core/plan/test_plan.hpp"

namespace drift::diagnosis {

/// Extra positions that would tell causes apart that a test has left equally likely.
struct Advice {
  std::string text;                    ///< one sentence for the person who plans the next test
  std::vector<Position> plan;          ///< to be added behind the plan, in this order
  std::vector<std::string> separates;  ///< labels of the causes
  double expected_sigma = 0.0;         ///< separation of the closest pair with them [1 sigma]
  double now_sigma = 0.0;              ///< without them
  double verified_sigma = 0.0;         ///< found by simulating the extended plan; NaN: not done
};

/// A position as an element of [[plan.position]]; every key is written, so that no default of the
/// file changes it.
config::Node position_node(const Position& position);

/// The positions as TOML, to be put behind the plan of a study that lists its positions.
std::string positions_toml(const std::vector<Position>& positions);

}  // namespace drift::diagnosis
