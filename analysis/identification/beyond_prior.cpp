#include "analysis/identification/beyond_prior.hpp"

#include <cmath>

#include "analysis/inference/thresholds.hpp"

namespace drift::identification {

std::vector<BeyondPrior> beyond_prior(const EstimateResult& estimate) {
  std::vector<BeyondPrior> far;
  for (const ParameterEstimate& p : estimate.parameters) {
    const double off = p.prior_sigma > 0.0 ? std::abs(p.value - p.prior_mean) / p.prior_sigma : 0.0;
    if (off > inference::FitLimits::beyond_prior) far.push_back({p.param, off});
  }
  return far;
}

}  // namespace drift::identification
