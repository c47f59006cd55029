#include "mc/store/study_state.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace drift::mc {

StudyState state_of(StudyReader& reader, const StopRules& rules) {
  StudyState s;
  s.asked = reader.runs();
  s.finished = reader.manifest().finished;
  const std::uint64_t finished = std::min(reader.manifest().finished, s.asked);
  for (std::size_t p = 0; p < reader.manifest().points.size(); ++p) {
    PointState& here = s.points.emplace_back();
    here.by_rule = reader.each_result(rules, p, [&](const StoredBlock& b) {
      here.runs += b.block.status.size();
      here.failed += b.failures.size();
      here.cpu_s += b.times.total_s;
    });
    here.complete = here.by_rule || (s.asked > 0 && here.runs >= s.asked);
    s.runs += here.runs;
    s.failed += here.failed;
    s.complete += here.complete;
    s.by_rule += here.by_rule && here.runs < s.asked;
    s.lost += !here.by_rule && here.runs < finished;
  }
  return s;
}

std::string StudyState::ended_by_rule() const {
  if (by_rule == 0) return {};
  std::uint64_t least = asked, most = 0;
  for (const PointState& p : points)
    if (p.by_rule && p.runs < asked) least = std::min(least, p.runs), most = std::max(most, p.runs);
  return fmt::format(
      "the stop rule ended {} early, after {} of at most {} runs",
      points.size() == 1 ? "the study" : fmt::format("{} of {} points", by_rule, points.size()),
      least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most), asked);
}

std::string StudyState::was_complete() const {
  return fmt::format(
      "the study was complete with {} runs per point; of {} of {} points results are not there any "
      "more",
      finished, lost, points.size());
}

}  // namespace drift::mc
