#include "analysis/identification/filter_odds.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/inference/misalignments.hpp"
#include "analysis/inference/thresholds.hpp"
#include "core/base/decompose.hpp"
#include "core/physics/stochastic.hpp"

namespace drift::identification {
namespace {

/// Whether the costs of two fits are of the same data and the same attitudes: the determinant is
/// that of the parameters alone.
bool comparable(const mc::Study& study, const Identification& id, const FilterSummary& a,
                const FilterSummary& b) {
  const FilterSpec &one = study.filters[a.filter], &other = study.filters[b.filter];
  return one.noise.angle_random_walk == other.noise.angle_random_walk &&
         one.initial_attitude == other.initial_attitude &&
         id.counted(a).batch.estimate.measured == id.counted(b).batch.estimate.measured;
}

std::optional<double> log_evidence(const mc::Study& study, const Identification& id,
                                   const FilterSummary& filter) {
  const FilterSpec& spec = study.filters[filter.filter];
  const FilterRun& run = id.counted(filter);
  const EstimateResult& fit = run.batch.estimate;
  if (&judged(spec, run) != &fit || fit.status != EstimateStatus::ok ||
      fit.covariance.size() == 0 || has_outliers(spec.model().terms))
    return std::nullopt;
  if (std::isfinite(fit.log_evidence)) return fit.log_evidence;
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

}  // namespace

std::vector<std::optional<double>> log_evidences(const mc::Study& study, const Identification& id) {
  std::vector<std::optional<double>> all(id.summaries.size());
  if (id.test_of_each_start) return all;
  const FilterSummary* first = nullptr;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const FilterSummary& s = id.summaries[k];
    const auto own = log_evidence(study, id, s);
    if (!own || (first != nullptr && !comparable(study, id, *first, s))) continue;
    if (first == nullptr) first = &s;
    all[k] = own;
  }
  return all;
}

std::optional<Favoured> favoured(const mc::Study& study, const Identification& id,
                                 const std::vector<std::size_t>& summaries) {
  constexpr double sure = inference::SearchLimits::credible;
  const auto evidences = log_evidences(study, id);
  if (summaries.empty() ||
      !std::ranges::all_of(summaries, [&](std::size_t k) { return evidences[k].has_value(); }))
    return std::nullopt;
  std::vector<std::size_t> order = summaries;
  std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t k) { return *evidences[k]; });
  const auto weight = [&](std::size_t k) {
    return std::exp(*evidences[k] - *evidences[order.front()]);
  };
  double whole = 0.0, held = 0.0, left = 0.0;
  for (const std::size_t k : order) whole += weight(k);
  Favoured out;
  for (const std::size_t k : order) {
    const bool enough = held > sure * whole;
    (enough ? out.others : out.filters).push_back(id.summaries[k].filter);
    (enough ? left : held) += weight(k);
  }
  out.log_odds = std::log(held / left);
  return out.others.empty() ? std::nullopt : std::optional(std::move(out));
}

}  // namespace drift::identification
