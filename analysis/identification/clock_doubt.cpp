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

using Result = BatchOptions::Result;

BatchResult fitted(const mc::Study& study, const std::vector<Recording>& recordings,
                   const FilterSpec& filter, Result result) {
  const preparation::RecordedTest test = preparation::recorded_test(study, recordings);
  return fit_batch(filter, {test.timeline, study.readout, test.measured}, make_layout(filter).theta,
                   {.result = result});
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

/// The study's own latitude with other times.
struct Retimed {
  ClockDoubt doubt;
  EstimateResult estimate;
};

/// The factor that fits best, by the parabola of the cost, the steps ever smaller; nothing where
/// there is no valley.
std::optional<Retimed> retimed_valley(const mc::Study& study,
                                      const std::vector<Recording>& recordings,
                                      const FilterSpec& filter, double near, double step) {
  const auto at = [&](double factor) {
    return fitted(study, with_times(recordings, factor), filter, Result::estimates).estimate;
  };
  Retimed out{{near, 0.0, at(1.0).statistic_per_dof(), 0.0}, {}};
  for (const double finer : {1.0, 0.1, 0.01}) {
    const double h = finer * step;
    const auto costs = mc::run_campaign(3, [&](std::size_t k) {
      return at(out.doubt.factor + (static_cast<double>(k) - 1.0) * h).statistic;
    });
    const double bend = costs[0] + costs[2] - 2.0 * costs[1];
    if (!(bend > 0.0)) return std::nullopt;
    out.doubt.factor += 0.5 * h * (costs[0] - costs[2]) / bend;
    out.doubt.sigma = h * std::sqrt(2.0 / bend);
    out.estimate = at(out.doubt.factor);
  }
  out.doubt.chi2_per_dof_after = out.estimate.statistic_per_dof();
  return out;
}

/// Nothing, too, where with such times it would be no recording of this plan: it is ours to try
/// them, and no fault of the file.
std::optional<Retimed> retimed(const mc::Study& study, const std::vector<Recording>& recordings,
                               const FilterSpec& filter, double near, double step) {
  try {
    return retimed_valley(study, recordings, filter, near, step);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

EstimateResult fitted_at(double latitude, mc::Study study, const std::vector<Recording>& recordings,
                         const FilterSpec& filter, Result result) {
  study.site.latitude = latitude;
  return fitted(study, recordings, filter, result).estimate;
}

}  // namespace

std::optional<ClockDoubt> clock_doubt(const mc::Study& study,
                                      const std::vector<Recording>& recordings,
                                      const FilterSpec& filter, double other_latitude) {
  const EstimateResult there = fitted_at(other_latitude, study, recordings, filter, Result::whole);
  const auto common = common_scale(there, torquer_scales);
  if (!common) return std::nullopt;
  // Torquers are off by themselves: the Earth's rate tells.
  const auto best = retimed(study, recordings, filter, 1.0 + common->value, common->sigma);
  if (!best) return std::nullopt;
  const double chance = stats::misfit_chance(best->doubt.chi2_per_dof_after,
                                             static_cast<double>(best->estimate.measured));
  if (best->estimate.statistic > there.statistic && chance < inference::SearchLimits::alpha)
    return std::nullopt;
  return best->doubt;
}

std::optional<ClockDoubt> clock_instead(const mc::Study& study,
                                        const std::vector<Recording>& recordings,
                                        const FilterSpec& filter, double other_latitude,
                                        double sigma) {
  const double slower = std::cos(other_latitude) / std::cos(study.site.latitude);
  if (!(slower > 0.5 && slower < 2.0) || !(sigma > 0.0)) return std::nullopt;
  const EstimateResult there =
      fitted_at(other_latitude, study, recordings, filter, Result::estimates);
  // What else is missing bends the latitude: the first step is as wide as a part of the way.
  const double step = std::max(sigma, 0.02 * std::abs(slower - 1.0));
  const auto best = retimed(study, recordings, filter, slower, step);
  if (!best) return std::nullopt;
  const double worse =
      (best->estimate.statistic - there.statistic) / std::max(1.0, there.statistic_per_dof());
  if (worse > -2.0 * std::log(inference::SearchLimits::alpha)) return std::nullopt;
  return best->doubt;
}

}  // namespace drift::identification
