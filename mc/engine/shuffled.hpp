#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/rng.hpp"

namespace drift::mc {

/// The same numbers in an order that is a pure function of the seed (Fisher and Yates).
inline std::vector<std::uint64_t> shuffled(std::vector<std::uint64_t> list, std::uint64_t seed) {
  Stream stream(seed, 0, Purpose::test);
  for (std::size_t i = list.size(); i > 1; --i)
    std::swap(list[i - 1],
              list[static_cast<std::size_t>(stream.uniform() * static_cast<double>(i))]);
  return list;
}

}  // namespace drift::mc
