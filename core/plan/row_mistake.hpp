#pragma once

#include <cstddef>
#include <string>

namespace drift {

/// What is wrong with a recording, and in which row it shows first.
struct RowMistake {
  std::size_t row = 0;
  std::string text;
};

}  // namespace drift
