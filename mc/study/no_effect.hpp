#pragma once

#include <optional>
#include <string>

#include "core/config/node.hpp"
#include "mc/study/study.hpp"

namespace drift::mc {

/// Why a key of a study file has no effect.
struct NoEffect {
  std::string why;         ///< "every position has a dwell of its own"
  std::string what_to_do;  ///< "Name that of a position, ..."
};

/// Why a key has no effect in a study, where that shows in the file: each member of a group, or
/// each position, has a value of its own, an instrument is not read, nothing slews. `key`: elements
/// of lists by number (config::numbered); `root`: the tree that the study was read from.
std::optional<NoEffect> no_effect(const config::Node& root, const Study& study,
                                  const std::string& key);

}  // namespace drift::mc
