#pragma once

#include <algorithm>

#include "mc/task/campaign.hpp"

namespace drift::planning {

/// Takes one candidate after another, each time the one of greatest merit, of equals the first, at
/// most `most`.
///
/// candidates(): how many there are for the next step; 0: that is enough. merit(k): of candidate k
/// beside those that were taken, compared by <; judged in parallel. take(k, its merit): takes it;
/// false: it is not worth it, and that is enough.
template <class Candidates, class MeritOf, class Take>
void take_greedily(std::size_t most, Candidates&& candidates, MeritOf&& merit, Take&& take,
                   int threads = 0) {
  for (std::size_t step = 0; step < most; ++step) {
    const auto merits = mc::run_campaign(candidates(), merit, threads);
    const auto best = std::max_element(merits.begin(), merits.end());
    if (best == merits.end() || !take(static_cast<std::size_t>(best - merits.begin()), *best))
      return;
  }
}

}  // namespace drift::planning
