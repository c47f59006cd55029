#include "analysis/identification/beyond_prior.hpp"

#include <algorithm>
#include <cmath>

#include "core/stats/normal.hpp"

namespace drift::identification {

std::vector<BeyondPrior> beyond_prior(const EstimateResult& estimate, double sigmas) {
  std::vector<BeyondPrior> far;
  for (const ParameterEstimate& p : estimate.parameters) {
    const double off = p.prior_sigma > 0.0 ? std::abs(p.value - p.prior_mean) / p.prior_sigma : 0.0;
    if (off > sigmas) far.push_back({p.param, off});
  }
  return far;
}

double farthest_by_chance(std::size_t parameters, double chance) {
  return stats::normal_half_width(1.0 - chance / static_cast<double>(parameters));
}

double chance_of_farthest(std::size_t parameters, double sigmas) {
  return static_cast<double>(parameters) * 2.0 * stats::normal_distribution(-sigmas);
}

EstimateResult of_data_alone(EstimateResult estimate) {
  double known = 0.0;
  for (const ParameterEstimate& p : estimate.parameters) {
    if (!(p.prior_sigma > 0.0)) continue;
    estimate.statistic -= std::pow((p.value - p.prior_mean) / p.prior_sigma, 2);
    known += 1.0 - std::min(1.0, p.learning_ratio() * p.learning_ratio());
  }
  const auto of_parameters = static_cast<std::size_t>(std::ceil(known));
  estimate.measured -= std::min(estimate.measured, of_parameters);
  return estimate;
}

}  // namespace drift::identification
