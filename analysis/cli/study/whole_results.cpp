#include "analysis/cli/study/whole_results.hpp"

#include "analysis/cli/print.hpp"
#include "core/base/check.hpp"

namespace drift::cli {

mc::StudyState require_whole(const std::string& folder, mc::StudyReader& reader,
                             const mc::StopRules& rules, const std::string& not_done) {
  mc::StudyState state = mc::state_of(reader, rules);
  for (const std::string& note : reader.notes()) complain("damage: {}\n", note);
  if (state.lost > 0 || (!state.all() && !reader.notes().empty()))
    throw InputError(
        ExitCode::store,
        fmt::format(
            "{}: {} (expected whole results). Run the study again with the same command: what "
            "is lost is computed anew. {}",
            folder, state.lost > 0 ? state.was_complete() : "parts of the results are damaged",
            not_done));
  return state;
}

void require_read_again(const std::string& folder, const mc::StudyReader& reader,
                        const std::string& made, std::uint64_t results) {
  std::uint64_t listed = 0;
  for (const mc::BlockKey& key : reader.keys()) listed += key.count;
  if (reader.unreadable() == 0 && listed >= results) return;
  for (const std::string& note : reader.notes()) complain("damage: {}\n", note);
  throw InputError(
      ExitCode::io,
      fmt::format("{}: results that were whole a moment ago could not be read again (expected a "
                  "disk that gives what it holds). {} is not of all results; check the disk and "
                  "run the same command again",
                  folder, made));
}

}  // namespace drift::cli
