#include "mc/export/hdf5_box.hpp"

#include <algorithm>

namespace drift::mc {

Box largest_box(const std::vector<hsize_t>& shape, hsize_t from, hsize_t most) {
  const std::size_t rank = shape.size();
  std::vector<hsize_t> behind(rank, 1);  // numbers of one step along each dimension
  for (std::size_t k = rank; k-- > 1;) behind[k - 1] = behind[k] * shape[k];
  Box box{std::vector<hsize_t>(rank, 0), std::vector<hsize_t>(rank, 1), 0};
  if (rank == 0 || most == 0 || from >= behind[0] * shape[0]) return box;
  for (std::size_t k = 0; k < rank; ++k) box.start[k] = from / behind[k] % shape[k];
  // The outermost dimension along which whole steps begin here and fit.
  std::size_t along = 0;
  while (from % behind[along] != 0 || behind[along] > most) ++along;
  box.count[along] = std::min(most / behind[along], shape[along] - box.start[along]);
  for (std::size_t k = along + 1; k < rank; ++k) box.count[k] = shape[k];
  box.numbers = box.count[along] * behind[along];
  return box;
}

}  // namespace drift::mc
