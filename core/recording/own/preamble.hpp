#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "core/recording/own/csv_layout.hpp"

namespace drift {

/// A value that stands above the rows of a file, as a study file has it.
struct PreambleValue {
  std::string value;     ///< "45.75 deg"
  std::size_t line = 0;  ///< where it stands, from 1
};

/// Where a recording was made, as the lines above its header say.
struct PreambleSite {
  std::optional<PreambleValue> latitude, gravity;
};

/// Takes what cannot be anything else: a line with one of a few words alone before a number in the
/// range that there is, in deg or N, S (latitude), m/s^2 (gravity) or without a unit, and nothing
/// behind it. Of two lines that differ neither is taken. InputError (io).
PreambleSite preamble_site(const std::string& path, const CsvLayout& layout);

}  // namespace drift
