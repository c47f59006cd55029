#include "analysis/strapdown/walking_drift.hpp"

#include <cmath>

#include "analysis/inference/projector.hpp"
#include "analysis/inference/signatures.hpp"
#include "analysis/search/fitted.hpp"

namespace drift::strapdown {

EstimateResult under_walk(const FilterSpec& filter, const MeasuredTest& test,
                          const BatchResult& fit) {
  const inference::NoiseModel declared = search::declared_noise(filter);
  return declared.drift_random_walk == 0.0 ? fit.estimate
                                           : under_noise(filter, test, fit, declared);
}

EstimateResult under_noise(const FilterSpec& filter, const MeasuredTest& test,
                           const BatchResult& fit, const inference::NoiseModel& noise) {
  if (fit.estimate.status == EstimateStatus::diverged) return fit.estimate;
  const inference::LinearProblem problem = inference::linear_problem(filter, test, fit, {});
  const inference::Projector projector(problem, noise);
  const inference::Projector::Fit best = projector.fit();
  EstimateResult out = fit.estimate;
  if (!best.x.allFinite() || !best.covariance.allFinite()) return out;
  out.covariance = best.covariance;
  for (std::size_t k = 0; k < out.parameters.size(); ++k) {
    ParameterEstimate& p = out.parameters[k];
    const auto i = static_cast<Eigen::Index>(k);
    p.value = p.prior_mean + p.prior_sigma * best.x[i];
    p.sigma = p.prior_sigma * std::sqrt(best.covariance(i, i));
  }
  out.statistic = projector.marginal().chi2;
  out.measured = static_cast<std::size_t>(projector.marginal().rows);
  return out;
}

}  // namespace drift::strapdown
