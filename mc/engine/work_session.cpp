#include "mc/engine/work_session.hpp"

namespace drift::mc {

std::vector<std::size_t> own_part(std::size_t n, const WorkerShare& share) {
  std::vector<std::size_t> part;
  for (std::size_t k = share.index; k < n; k += share.count) part.push_back(k);
  return part;
}

std::vector<std::size_t> own_part_first(std::size_t n, const WorkerShare& share) {
  std::vector<std::size_t> all = own_part(n, share);
  for (std::size_t next = 1; next < share.count; ++next) {
    const auto part = own_part(n, {(share.index + next) % share.count, share.count});
    all.insert(all.end(), part.rbegin(), part.rend());
  }
  return all;
}

}  // namespace drift::mc
