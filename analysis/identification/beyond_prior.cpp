#include "analysis/identification/beyond_prior.hpp"

#include <cmath>

namespace drift::identification {

std::vector<BeyondPrior> beyond_prior(const EstimateResult& estimate, double sigmas) {
  std::vector<BeyondPrior> far;
  for (const ParameterEstimate& p : estimate.parameters) {
    const double off = p.prior_sigma > 0.0 ? std::abs(p.value - p.prior_mean) / p.prior_sigma : 0.0;
    if (off > sigmas) far.push_back({p.param, off});
  }
  return far;
}

}  // namespace drift::identification
