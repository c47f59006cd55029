#include "analysis/identification/filter_odds.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/inference/misalignments.hpp"
#include "analysis/inference/thresholds.hpp"
#include "core/base/decompose.hpp"

namespace drift::identification {
namespace {

/// Whether two filters are of one test and give the same noise to its rows.
bool comparable(const mc::Study& study, const Identification& id, const FilterSummary& a,
                const FilterSummary& b) {
  const auto &noise = study.filters[a.filter].noise, &other = study.filters[b.filter].noise;
  return noise.angle_random_walk == other.angle_random_walk &&
         id.counted(a).batch.estimate.measured == id.counted(b).batch.estimate.measured;
}

}  // namespace

std::optional<double> log_evidence(const mc::Study& study, const Identification& id,
                                   const FilterSummary& filter) {
  const FilterSpec& spec = study.filters[filter.filter];
  const FilterRun& run = id.counted(filter);
  const EstimateResult& fit = run.batch.estimate;
  if (&judged(spec, run) != &fit || fit.status != EstimateStatus::ok ||
      fit.covariance.size() == 0 || has_outliers(spec.model().terms))
    return std::nullopt;
  VecX off(static_cast<Eigen::Index>(fit.parameters.size()));
  for (Eigen::Index k = 0; k < off.size(); ++k) {
    const ParameterEstimate& p = fit.parameters[static_cast<std::size_t>(k)];
    off[k] = (p.value - p.prior_mean) / p.prior_sigma;
  }
  const double root_det = Cholesky(fit.covariance).L().diagonal().array().log().sum();
  const double evidence = -0.5 * fit.statistic + root_det +
                          inference::log_gain_of_misalignments(filter.layout, off, fit.covariance);
  return std::isfinite(evidence) ? std::optional(evidence) : std::nullopt;
}

std::optional<FavouredFilter> favoured(const mc::Study& study, const Identification& id,
                                       const std::vector<std::size_t>& summaries) {
  if (summaries.size() < 2 || id.test_of_each_start) return std::nullopt;
  std::vector<double> logs;
  for (const std::size_t k : summaries) {
    const FilterSummary& s = id.summaries[k];
    const auto evidence = log_evidence(study, id, s);
    if (!evidence || !comparable(study, id, id.summaries[summaries.front()], s))
      return std::nullopt;
    logs.push_back(*evidence);
  }
  const auto best = std::ranges::max_element(logs) - logs.begin();
  FavouredFilter out;
  out.filter = id.summaries[summaries[static_cast<std::size_t>(best)]].filter;
  double against = 0.0;
  for (std::size_t k = 0; k < logs.size(); ++k) {
    if (k == static_cast<std::size_t>(best)) continue;
    against += std::exp(logs[k] - logs[static_cast<std::size_t>(best)]);
    out.others.push_back(id.summaries[summaries[k]].filter);
  }
  out.log_odds = -std::log(against);
  constexpr double sure = inference::SearchLimits::credible;
  return against < (1.0 - sure) / sure ? std::optional(std::move(out)) : std::nullopt;
}

}  // namespace drift::identification
