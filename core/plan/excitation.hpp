#pragma once

#include <array>

#include "core/plan/timeline.hpp"

namespace drift {

/// What a test does to the instruments by its commands and its nominal attitudes. Of a term whose
/// input is zero all the time nothing can be seen.
struct Excitation {
  std::array<bool, 3> commanded{};  ///< whether there is ever a command about the platform axis
  /// Whether specific force is ever along both platform axes at once.
  std::array<std::array<bool, 3>, 3> along_both{};
};

/// Of what is no more than the rounding of the attitudes, which are carried on from node to node,
/// or of the commands that follow from them, there is none.
Excitation excitation_of(const Timeline& timeline);

}  // namespace drift
