#include "mc/engine/forecast.hpp"

#include <algorithm>

#include "mc/engine/inventory.hpp"
#include "mc/store/worker_lock.hpp"

namespace drift::mc {

Forecast forecast(const StudyWork& work, const EngineOptions& options, const std::string& folder,
                  const Manifest& manifest, bool begun, std::size_t worker) {
  Forecast found;
  require_no_other(worker_path(folder, worker), worker_patience);
  StudyReader reader =
      begun ? StudyReader(folder) : StudyReader(folder, std::make_shared<Manifest>(manifest));
  RuleFollower rules(work.stop_rules, options.runs, reader);
  rules.advance();
  const std::vector<BlockKey> all = all_blocks(manifest, options.runs);
  const Listed listed = list_stored(reader, all, rules);
  found.stored = listed.runs;
  found.cut_short = listed.cut_short;
  for (const BlockKey& key : reader.keys()) {
    const std::uint64_t asked = options.runs - std::min(options.runs, key.first);
    found.beyond += key.count - std::min<std::uint64_t>(key.count, asked);
  }
  if (begun) found.asked_before = reader.runs();
  for (const std::uint64_t i : verify_stored(reader, all, rules, work.stop_rules).missing) {
    // Listed, and damaged: a session meets it when nothing else is missing.
    if (!std::ranges::binary_search(listed.missing, i)) found.stored -= all[i].count;
    if (options.share.has(i))
      found.own.push_back(all[i]);
    else
      ++found.others;
  }
  found.kept = runs_of(reader.kept([&](std::size_t point, std::uint64_t first) {
    return std::ranges::binary_search(
        found.own, std::pair(point, first), {},
        [](const BlockKey& block) { return std::pair(block.point, block.first); });
  }));
  found.notes = reader.notes();
  return found;
}

}  // namespace drift::mc
