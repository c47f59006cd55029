#include "analysis/identification/counted_start.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/estimate/start_consistency.hpp"
#include "core/physics/stochastic.hpp"

namespace drift::identification {
namespace {

constexpr double one_sigma = 1.0;  ///< of chi-square above its minimum

bool converged(const EstimateResult& result) {
  return result.status == EstimateStatus::ok && std::isfinite(result.statistic);
}

/// What a linear EKF would have kept of the difference of two starts, in prior sigmas.
VecX kept_of_starts(const EstimateResult& a, const EstimateResult& b) {
  const auto n = static_cast<Eigen::Index>(a.parameters.size());
  VecX z(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double prior = a.parameters[i].prior_sigma;
    z[k] = prior > 0.0 ? (a.parameters[i].start - b.parameters[i].start) / prior : 0.0;
  }
  return a.covariance.rows() == n ? VecX(a.covariance * z) : VecX(VecX::Zero(n));
}

bool agree(const EstimateResult& a, const EstimateResult& b, bool keeps_start) {
  const auto n = static_cast<Eigen::Index>(a.parameters.size());
  const VecX kept = keeps_start ? kept_of_starts(a, b) : VecX(VecX::Zero(n));
  for (std::size_t k = 0; k < a.parameters.size(); ++k) {
    const ParameterEstimate &p = a.parameters[k], &q = b.parameters[k];
    const std::array values{p.value - q.value - kept[static_cast<Eigen::Index>(k)] * p.prior_sigma,
                            0.0};
    const std::array sigmas{p.sigma, q.sigma};
    if (start_verdict(start_consistency(values, sigmas)) != StartVerdict::consistent) return false;
  }
  return true;
}

/// Of each run; infinite where it did not converge.
std::vector<double> costs_of(const FilterSpec& filter, const std::vector<const FilterRun*>& runs,
                             Measured measured) {
  std::size_t most = 0;
  for (const FilterRun* run : runs)
    if (const EstimateResult& r = judged(filter, *run); converged(r))
      most = std::max(most, r.measured);
  const double gate = outlier_gate(make_layout(filter).theta);
  std::vector<double> costs;
  for (const FilterRun* run : runs) {
    const EstimateResult& r = judged(filter, *run);
    const double left_out = static_cast<double>(most) - static_cast<double>(r.measured);
    costs.push_back(!converged(r)                         ? HUGE_VAL
                    : measured == Measured::by_each_start ? 0.0
                                                          : r.statistic + gate * gate * left_out);
  }
  return costs;
}

}  // namespace

CountedStart counted_start(const FilterSpec& filter, const std::vector<const FilterRun*>& runs,
                           Measured measured) {
  const std::vector<double> costs = costs_of(filter, runs, measured);
  const auto least = std::ranges::min_element(costs);
  CountedStart counted;
  if (!std::isfinite(*least)) return counted;
  const auto best = static_cast<std::size_t>(least - costs.begin());
  counted.start = best;
  const bool keeps_start = drift_varies(filter);  // the EKF is judged
  const auto agree_with = [&](std::size_t k, std::size_t other) {
    return std::isfinite(costs[k]) &&
           agree(judged(filter, *runs[k]), judged(filter, *runs[other]), keeps_start);
  };
  for (std::size_t k = best; k-- > 0;)
    if (costs[k] < *least + one_sigma && agree_with(k, best)) counted.start = k;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    counted.agreeing += agree_with(k, counted.start);
    if (costs[k] < *least + one_sigma) counted.as_good.push_back(k);
  }
  return counted;
}

bool fits(const EstimateResult& result) {
  return result.status == EstimateStatus::ok && !misfit(result);
}

void try_prior_means(const mc::Study& study, Identification& id,
                     const std::function<FilterRun(std::size_t, std::size_t)>& estimate) {
  for (std::size_t f = 0; f < study.filters.size(); ++f) {
    const FilterSpec& filter = study.filters[f];
    auto runs = id.runs_of(f);
    const std::size_t before = counted_start(filter, runs, Measured::once).start;
    if (!filter.starts.empty() || fits(judged(filter, *runs[before]))) continue;
    FilterRun mean = estimate(f, runs.size());
    runs.push_back(&mean);
    if (fits(judged(filter, mean)) &&
        counted_start(filter, runs, Measured::once).start + 1 == runs.size())
      id.runs.insert(std::ranges::upper_bound(id.runs, f, {}, &FilterRun::filter), std::move(mean));
  }
}

}  // namespace drift::identification
