#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/recording/recording.hpp"

namespace drift::identification {

/// That recordings were made with a loop that removes an estimate of the gyros' misalignments
/// (coupling "compensated"): they carry it, and it is not zero.
struct StatedLoop {
  std::vector<std::size_t> recordings;  ///< their numbers, from 1
  bool whole = true;  ///< every recording has all six columns, which that coupling needs
};

/// Empty where none states one. Only a filter of that coupling looks at the columns.
std::optional<StatedLoop> stated_loop(const std::vector<Recording>& recordings);

}  // namespace drift::identification
