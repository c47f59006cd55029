#pragma once

#include <hdf5.h>

#include <vector>

namespace drift::mc {

/// A box within an array: what HDF5 moves at once.
struct Box {
  std::vector<hsize_t> start, count;  ///< of each dimension
  hsize_t numbers = 0;                ///< in it
};

/// The largest box that holds the numbers from place `from` on, in their order (the last dimension
/// fastest), and at most `most` of them. Empty behind the end.
Box largest_box(const std::vector<hsize_t>& shape, hsize_t from, hsize_t most);

}  // namespace drift::mc
