#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "core/base/rng.hpp"

namespace drift {

/// Brings a list into an order that is a pure function of the stream (Fisher and Yates), every
/// order as probable as another.
template <class T>
void shuffle(std::vector<T>& list, Stream& stream) {
  for (std::size_t left = list.size(); left > 1; --left)
    std::swap(list[left - 1],
              list[static_cast<std::size_t>(stream.uniform() * static_cast<double>(left))]);
}

}  // namespace drift
