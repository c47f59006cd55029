#pragma once

#include <vector>

#include "analysis/blind/score.hpp"
#include "core/stats/proportion.hpp"

namespace drift::blind {

/// Trials whose most probable explanation was stated with a probability in [low, high).
struct ReliabilityBin {
  double low = 0.0, high = 1.0, stated = 0.0;  ///< mean of what was stated
  stats::Proportion right;
};

/// Whether stated probabilities are right: of each bin the share of right ones.
struct Reliability {
  std::vector<ReliabilityBin> bins;
  /// Mean over trials of |stated probability - share of right ones| of their bins; NaN without any.
  double error = 0.0;
  double error_by_chance =
      0.0;  ///< what it would be, on average, were they right as often as stated
};

Reliability reliability_of(const std::vector<TrialScore>& scores);

/// What could be named at all: right ones where every cause that is the most probable answer is
/// named, the surest first, as long as no more than this part of the trials is expected to be named
/// wrongly by what was stated. No rule that goes by these probabilities names more for that price.
stats::Proportion right_if_named_by_probability(const std::vector<TrialScore>& scores,
                                                double wrong);

}  // namespace drift::blind
