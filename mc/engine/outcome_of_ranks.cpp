#include "mc/engine/outcome_of_ranks.hpp"

namespace drift::mc {

void share_with_all(StudyOutcome& outcome, Ranks& ranks) {
  std::vector<std::uint64_t> told{static_cast<std::uint64_t>(outcome.code),
                                  outcome.complete,
                                  outcome.failed,
                                  outcome.results,
                                  outcome.missing,
                                  outcome.missing_own};
  ranks.broadcast(told);
  outcome.code = static_cast<ExitCode>(told[0]);
  outcome.complete = told[1] != 0;
  outcome.failed = told[2], outcome.results = told[3];
  outcome.missing = told[4], outcome.missing_own = told[5];
}

}  // namespace drift::mc
