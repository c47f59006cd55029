#include "analysis/identification/clock_doubt.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/identification/common_scale.hpp"
#include "analysis/identification/parabola_foot.hpp"
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

/// A first step as wide as a part of the way: what else is missing bends the valley.
double first_step(double sigma, double way) {
  return std::max(sigma, 0.02 * std::abs(way));
}

/// The study's own latitude with other times.
struct Retimed {
  ClockDoubt doubt;
  EstimateResult estimate;
};

/// The factor that fits best, by the parabola of the cost, the steps ever smaller; nothing where
/// there is no valley.
std::optional<Retimed> retimed_valley(const FitAtTimes& at, double near, double step) {
  Retimed out{{near, 0.0, at(1.0).statistic_per_dof(), 0.0}, {}};
  for (const double finer : {1.0, 0.1, 0.01}) {
    const double h = finer * step;
    const auto costs = mc::run_campaign(3, [&](std::size_t k) {
      return at(out.doubt.factor + (static_cast<double>(k) - 1.0) * h).statistic;
    });
    const auto foot = foot_of(costs, h);
    if (!foot) return std::nullopt;
    out.doubt.factor += foot->at;
    out.doubt.sigma = foot->sigma;
    out.estimate = at(out.doubt.factor);
  }
  out.doubt.chi2_per_dof_after = out.estimate.statistic_per_dof();
  return out;
}

/// The filter fitted to the recordings with their times so many times as long.
FitAtTimes fit_of(const mc::Study& study, const std::vector<Recording>& recordings,
                  const FilterSpec& filter) {
  return [&](double factor) {
    return fitted(study, with_times(recordings, factor), filter, Result::estimates).estimate;
  };
}

/// Nothing, too, where with such times it would be no recording of this plan: it is ours to try
/// them, and no fault of the file.
std::optional<Retimed> retimed(const FitAtTimes& at, double near, double step) {
  try {
    return retimed_valley(at, near, step);
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
  const auto best = retimed(fit_of(study, recordings, filter), 1.0 + common->value, common->sigma);
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
  const auto best =
      retimed(fit_of(study, recordings, filter), slower, first_step(sigma, slower - 1.0));
  if (!best) return std::nullopt;
  const double worse =
      (best->estimate.statistic - there.statistic) / std::max(1.0, there.statistic_per_dof());
  if (worse > -2.0 * std::log(inference::SearchLimits::alpha)) return std::nullopt;
  return best->doubt;
}

std::optional<ClockDoubt> clock_of_misfit(const FitAtTimes& at, double promised) {
  constexpr double h = 1e-4;  // a clock is seldom off by more (9 s a day): there a fit is linear
  std::vector<double> costs;
  try {
    costs = mc::run_campaign(
        3, [&](std::size_t k) { return at(1.0 + (static_cast<double>(k) - 1.0) * h).statistic; });
  } catch (const InputError&) {
    return std::nullopt;  // as of retimed()
  }
  const auto foot = foot_of(costs, h);
  if (!foot || foot->fall < promised || !(1.0 + foot->at > 0.0)) return std::nullopt;
  auto best = retimed(at, 1.0 + foot->at, first_step(foot->sigma, foot->at));
  if (!best) return std::nullopt;
  const double gain =
      (costs[1] - best->estimate.statistic) / std::max(1.0, best->estimate.statistic_per_dof());
  best->doubt.weigh(gain);
  return best->doubt;
}

std::optional<ClockDoubt> clock_of_misfit(const mc::Study& study,
                                          const std::vector<Recording>& recordings,
                                          const FilterSpec& filter, double promised) {
  return clock_of_misfit(fit_of(study, recordings, filter), promised);
}

void ClockDoubt::weigh(double chi2_above) {
  const double every_factor = 2.0 * std::numbers::ln2;  // from log(1/2) to log(2)
  if (sigma > 0.0 && factor > 0.0)
    log_evidence = 0.5 * chi2_above + 0.5 * std::log(2.0 * std::numbers::pi) +
                   std::log(sigma / factor) - std::log(every_factor);
}

bool ClockDoubt::evident() const {
  return log_evidence + std::log(inference::SiteLimits::another) > 0.0;
}

}  // namespace drift::identification
