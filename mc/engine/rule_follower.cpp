#include "mc/engine/rule_follower.hpp"

#include <algorithm>

namespace drift::mc {

RuleFollower::RuleFollower(const StopRules& make, std::uint64_t runs, StudyReader& reader)
    : runs_(runs), reader_(reader), points_(make ? reader.manifest().points.size() : 0) {
  for (std::size_t p = 0; p < points_.size(); ++p) points_[p].rule = make(p);
}

void RuleFollower::advance() {
  if (points_.empty()) return;
  const std::uint64_t size = reader_.manifest().identity.block_size;
  reader_.refresh();
  for (std::size_t p = 0; p < points_.size(); ++p) {
    Point& point = points_[p];
    while (point.rule && !point.enough && point.next < runs_) {
      const auto block = reader_.read(p, point.next);
      // The last block of a study with fewer runs is not that of this one.
      if (!block || block->block.status.size() < std::min(size, runs_ - point.next)) break;
      point.next += size;
      if (point.rule->enough(block->block)) point.enough = true;
    }
  }
}

}  // namespace drift::mc
