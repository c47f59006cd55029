#include "analysis/identification/common_scale.hpp"

#include <cmath>

#include "analysis/inference/thresholds.hpp"

namespace drift::identification {
namespace {

using inference::FitLimits;
}  // namespace

std::optional<CommonScale> common_scale(const EstimateResult& estimate,
                                        const ScaleFactors& scales) {
  CommonScale common;
  double of_priors = 0.0;
  for (const std::size_t scale : scales) {
    const ParameterEstimate* p = estimate.find(scale);
    if (p == nullptr || !(p->prior_sigma > 0.0)) return std::nullopt;
    common.value += (p->value - p->prior_mean) / 3.0;
    common.sigma = std::hypot(common.sigma, p->sigma / 3.0, p->prior_sigma / 3.0);
    of_priors = std::hypot(of_priors, p->prior_sigma / 3.0);
  }
  double unlike = 0.0;  // chi-square of two degrees of freedom where the priors are right
  for (const std::size_t scale : scales) {
    const ParameterEstimate& p = *estimate.find(scale);
    unlike += std::pow((p.value - p.prior_mean - common.value) / p.prior_sigma, 2);
  }
  if (!(std::abs(common.value) > FitLimits::beyond_prior * of_priors) ||
      std::exp(-0.5 * unlike) < FitLimits::unlike_scales)
    return std::nullopt;
  return common;
}

EstimateResult without_prior_cost(EstimateResult estimate, const ScaleFactors& scales) {
  for (const std::size_t scale : scales)
    if (const ParameterEstimate* p = estimate.find(scale); p != nullptr && p->prior_sigma > 0.0)
      estimate.statistic -= std::pow((p->value - p->prior_mean) / p->prior_sigma, 2);
  return estimate;
}

}  // namespace drift::identification
