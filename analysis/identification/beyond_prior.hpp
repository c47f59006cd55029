#pragma once

#include <vector>

#include "core/estimate/estimate_result.hpp"

namespace drift::identification {

/// A parameter that an estimate takes further from its prior's mean than FitLimits::beyond_prior.
struct BeyondPrior {
  std::size_t param = 0;  ///< index in TermLibrary
  double sigmas = 0.0;    ///< of the prior
};

/// All of an estimate, in its order.
std::vector<BeyondPrior> beyond_prior(const EstimateResult& estimate);

}  // namespace drift::identification
