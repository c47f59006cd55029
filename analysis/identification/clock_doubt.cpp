#include "analysis/identification/clock_doubt.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/identification/common_scale.hpp"
#include "analysis/inference/thresholds.hpp"
#include "analysis/preparation/recorded_test.hpp"
#include "core/base/check.hpp"
#include "core/estimate/batch.hpp"
#include "core/estimate/layout.hpp"
#include "core/stats/chi_square_band.hpp"
#include "mc/task/campaign.hpp"

namespace drift::identification {
namespace {

BatchResult fitted(const mc::Study& study, const std::vector<Recording>& recordings,
                   const FilterSpec& filter) {
  const preparation::RecordedTest test = preparation::recorded_test(study, recordings);
  return fit_batch(filter, {test.timeline, study.readout, test.measured},
                   make_layout(filter).theta);
}

std::vector<Recording> with_times(std::vector<Recording> recordings, double factor) {
  for (Recording& r : recordings) {
    for (Channel& c : r.channels)
      if (c.name == "time")
        for (double& t : c.values) t *= factor;
    for (double& t : r.begins) t *= factor;
  }
  return recordings;
}

}  // namespace

std::optional<ClockDoubt> clock_doubt(const mc::Study& study,
                                      const std::vector<Recording>& recordings,
                                      const FilterSpec& filter, double other_latitude) {
  mc::Study elsewhere = study;
  elsewhere.site.latitude = other_latitude;
  const EstimateResult there = fitted(elsewhere, recordings, filter).estimate;
  const auto common = common_scale(there, torquer_scales);
  if (!common) return std::nullopt;
  const auto at = [&](double factor) {
    return fitted(study, with_times(recordings, factor), filter).estimate;
  };
  ClockDoubt doubt{1.0 + common->value, 0.0, at(1.0).statistic_per_dof(), 0.0};
  EstimateResult best;
  // Torquers are off by themselves: the Earth's rate tells. Its parabola, the step ever smaller.
  for (const double step : {common->sigma, 0.1 * common->sigma, 0.01 * common->sigma}) {
    const auto costs = mc::run_campaign(3, [&](std::size_t k) {
      return at(doubt.factor + (static_cast<double>(k) - 1.0) * step).statistic;
    });
    const double bend = costs[0] + costs[2] - 2.0 * costs[1];
    if (!(bend > 0.0)) return std::nullopt;
    doubt.factor += 0.5 * step * (costs[0] - costs[2]) / bend;
    doubt.sigma = step * std::sqrt(2.0 / bend);
    best = at(doubt.factor);
  }
  doubt.chi2_per_dof_after = best.statistic_per_dof();
  const double chance =
      doubt.chi2_per_dof_after > 1.0
          ? stats::chi_square_chance(doubt.chi2_per_dof_after, static_cast<double>(best.measured))
          : 1.0;
  if (best.statistic > there.statistic && chance < inference::SearchLimits::alpha)
    return std::nullopt;
  return doubt;
}

}  // namespace drift::identification
