#pragma once

#include <span>
#include <vector>

#include "analysis/inference/thresholds.hpp"
#include "analysis/planning/position_pool.hpp"
#include "analysis/planning/separation.hpp"

namespace drift::planning {

/// What is to be set apart, and what is enough.
struct Aim {
  std::span<const Trace> traces;
  std::span<const Contest> pairs;
  std::size_t most = inference::AdviceLimits::most;  ///< additions
  double wanted = inference::AdviceLimits::wanted;   ///< separation that is enough [1 sigma]
};

/// Additions of a pool that bring the pairs nearest to `wanted` (the mean of sigma / wanted, each
/// at most 1), one after another: by what each brings over the time it takes, and by what each
/// brings. Of both the one that comes nearer; where both reach it the shorter, unless twice the
/// time sets the closest pair more than twice as far apart. Indices into the pool, in the order of
/// choice. recorded: what is known without them.
std::vector<std::size_t> choose_additions(const Information& recorded,
                                          const std::vector<Candidate<Information>>& pool,
                                          const Aim& aim);

}  // namespace drift::planning
