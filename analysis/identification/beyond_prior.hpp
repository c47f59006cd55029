#pragma once

#include <vector>

#include "analysis/inference/thresholds.hpp"
#include "core/estimate/estimate_result.hpp"

namespace drift::identification {

/// A parameter that an estimate takes far from its prior's mean.
struct BeyondPrior {
  std::size_t param = 0;  ///< index in TermLibrary
  double sigmas = 0.0;    ///< of the prior
};

/// Those further than so many prior sigmas, in the order of the estimate.
std::vector<BeyondPrior> beyond_prior(const EstimateResult& estimate,
                                      double sigmas = inference::FitLimits::beyond_prior);

/// [prior sigma] The farthest of so many parameters, each of its prior, lies beyond it with no more
/// than this chance.
double farthest_by_chance(std::size_t parameters, double chance);
/// Chance that the farthest of so many lies as far.
double chance_of_farthest(std::size_t parameters, double sigmas);

/// The estimate of a batch fit as the data have it by themselves: its statistic without what the
/// priors of its parameters cost, over the degrees of freedom that are left of what was measured,
/// one taken off for each parameter as far as the data know it. Where priors are wrong and the
/// model is right, that is chi-square over its degrees of freedom still.
EstimateResult of_data_alone(EstimateResult estimate);

}  // namespace drift::identification
