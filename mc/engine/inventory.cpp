#include "mc/engine/inventory.hpp"

namespace drift::mc {

namespace {

/// A rule waits at a damaged block, which must be known for it to go on; it reads all there is
/// anyway.
std::size_t stored_runs(StudyReader& reader, const BlockEntry& entry, const RuleFollower& rules) {
  if (!rules.follows()) return entry.key.count;
  const auto block = reader.read(entry.key.point, entry.key.first);
  return block ? block->block.status.size() : 0;
}

}  // namespace

Listed list_stored(StudyReader& reader, const std::vector<BlockKey>& all,
                   const RuleFollower& rules) {
  Listed found;
  for (std::uint64_t i = 0; i < all.size(); ++i) {
    const BlockEntry* entry = reader.listed(all[i].point, all[i].first);
    const std::size_t runs = entry != nullptr ? stored_runs(reader, *entry, rules) : 0;
    if (runs >= all[i].count) {
      found.runs += all[i].count;
      found.failed += entry->failed;
      continue;
    }
    found.cut_short += runs;
    if (!rules.enough(all[i].point)) found.missing.push_back(i);
  }
  return found;
}

Verified verify_stored(StudyReader& reader, const std::vector<BlockKey>& all,
                       const RuleFollower& follower, const StopRules& rules) {
  const Manifest& manifest = reader.manifest();
  const std::size_t each = all.size() / manifest.points.size();
  std::vector<bool> whole(all.size());
  Verified found;
  ResultsDigest digest(manifest);
  reader.each_result(rules, [&](const StoredBlock& b) {
    const std::size_t runs = b.block.status.size();
    const std::uint64_t place = b.block.first / manifest.identity.block_size;
    const std::size_t i = b.block.point * each + place;
    if (place < each && runs >= all[i].count) whole[i] = true;
    found.results += runs;
    found.failed += b.failures.size();
    digest.add(b);
  });
  found.digest = digest.finish();
  for (std::uint64_t i = 0; i < all.size(); ++i)
    if (!whole[i] && !follower.enough(all[i].point)) found.missing.push_back(i);
  return found;
}

}  // namespace drift::mc
