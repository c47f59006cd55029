#include "analysis/identification/delay_doubt.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "analysis/identification/parabola_foot.hpp"
#include "analysis/inference/thresholds.hpp"
#include "analysis/preparation/recorded_test.hpp"
#include "core/base/check.hpp"
#include "core/estimate/batch.hpp"
#include "core/estimate/layout.hpp"
#include "core/recording/instants/shifted_readings.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/recording/rows/row_spacing.hpp"
#include "core/stats/chi_square_band.hpp"
#include "core/stats/median.hpp"
#include "mc/task/campaign.hpp"

namespace drift::identification {
namespace {

constexpr double shortest = 1e-3, longest = 600.0;  // [s] delays that may be
constexpr double as_estimated = 3.0;                // [sigma], 0.3 % of the right ones
constexpr double short_mean = 0.2;        // part of the interval over which a converter may average
constexpr double part_of_interval = 0.1;  // steps of the first fits

const ChannelTriple& channels_of(DelayDoubt::Of of) {
  return of == DelayDoubt::Of::accelerometers ? accelerometer_channels : gimbal_channels;
}

/// Without what instruments read while the platform slews.
std::vector<Recording> without_slews(std::vector<Recording> recordings) {
  for (Recording& r : recordings) {
    const Channel* phase = r.find("phase");
    if (phase == nullptr) continue;
    const std::vector<double> slew = phase->values;
    for (Channel& c : r.channels)
      if (c.name.starts_with("acc_") || c.name.starts_with("gimbal_"))
        for (std::size_t row = 0; row < slew.size(); ++row)
          if (slew[row] == 1.0) c.values[row] = nan_value;
  }
  return recordings;
}

EstimateResult estimate_of(const mc::Study& study, const std::vector<Recording>& recordings,
                           const FilterSpec& filter, BatchOptions::Result result) {
  const preparation::RecordedTest test = preparation::recorded_test(study, recordings);
  return fit_batch(filter, {test.timeline, study.readout, test.measured}, make_layout(filter).theta,
                   {.result = result})
      .estimate;
}

std::vector<double> costs_around(const FitAtDelay& at, DelayDoubt::Of of, double middle, double h) {
  return mc::run_campaign(3, [&](std::size_t k) {
    return at(of, middle + (static_cast<double>(k) - 1.0) * h).statistic;
  });
}

/// The delay of one kind of instrument, if the first parabola promises enough.
std::optional<DelayDoubt> delay_of(DelayDoubt::Of of, const FitAtDelay& at,
                                   const EstimateResult& as_read, double interval, double promise) {
  const double h = part_of_interval * interval;
  const auto beside =
      mc::run_campaign(2, [&](std::size_t k) { return at(of, k == 0 ? -h : h).statistic; });
  auto foot = foot_of({beside[0], as_read.statistic, beside[1]}, h);
  const auto dof = static_cast<double>(std::max<std::size_t>(1, as_read.measured));
  if (!foot || foot->fall < promise * std::max(0.0, as_read.statistic - dof)) return std::nullopt;
  DelayDoubt out{.of = of, .late = foot->at, .sigma = foot->sigma, .interval = interval};
  for (const double finer : {0.1, 0.02}) {
    if (!(std::abs(out.late) <= longest)) return std::nullopt;
    const double step = std::max(out.sigma, finer * std::abs(out.late));
    foot = foot_of(costs_around(at, of, out.late, step), step);
    if (!foot) return std::nullopt;
    out.late += foot->at;
    out.sigma = foot->sigma;
  }
  const EstimateResult best = at(of, out.late);
  const double scale = std::max(1.0, best.statistic_per_dof());
  out.chi2_per_dof_before = as_read.statistic_per_dof();
  out.chi2_per_dof_after = best.statistic_per_dof();
  out.chance_after = stats::misfit_chance(out.chi2_per_dof_after, dof);
  out.weigh((as_read.statistic - best.statistic) / scale);
  return out;
}

}  // namespace

std::optional<DelayDoubt> delay_of_misfit(const FitAtDelay& at, double interval, double promise) {
  if (!(interval > 0.0)) return std::nullopt;
  std::optional<DelayDoubt> best;
  try {
    using enum DelayDoubt::Of;
    const EstimateResult as_read = at(accelerometers, 0.0);  // of either
    const auto of_accelerometers = delay_of(accelerometers, at, as_read, interval, promise),
               of_gimbals = delay_of(gimbals, at, as_read, interval, promise);
    best = of_gimbals ? of_gimbals : of_accelerometers;
    if (of_gimbals && of_accelerometers) {
      const double more = of_accelerometers->log_evidence - of_gimbals->log_evidence;
      const double decided = std::log(inference::RemarkLimits::decided);
      // Where neither is likelier, momentary readings are the ordinary ones.
      if (more > (of_accelerometers->momentary() ? -decided : decided)) best = of_accelerometers;
      best->either = std::abs(more) <= decided;
    }
  } catch (const InputError&) {
    return std::nullopt;  // no recording of this plan with such readings: ours to try, no fault
  }
  return best;
}

std::optional<DwellsAlone> dwells_alone(const mc::Study& study,
                                        const std::vector<Recording>& recordings) {
  const bool both = std::ranges::any_of(recordings, [](const Recording& r) {
    return r.find("acc_x") != nullptr && r.find("gimbal_outer") != nullptr;
  });
  if (!both || !study.readout.accelerometers || !study.readout.gimbals) return std::nullopt;
  DwellsAlone out{study, without_slews(recordings)};
  double acc = 0.0, gimbal = 0.0;  // NaN counts for nothing
  for (const Recording& r : out.recordings) {
    acc = std::fmax(acc, scatter_about_course(r, accelerometer_channels.names));
    gimbal = std::fmax(gimbal, scatter_about_course(r, gimbal_channels.names));
  }
  out.study.readout.accelerometer_noise = std::max(study.readout.accelerometer_noise, acc);
  out.study.readout.gimbal_noise = std::max(study.readout.gimbal_noise, gimbal);
  return out;
}

std::optional<DelayDoubt> delay_of_misfit(const DwellsAlone& test, const FilterSpec& filter,
                                          double interval) {
  const auto found = delay_of_misfit(
      [&](DelayDoubt::Of of, double seconds) {
        std::vector<Recording> shifted = test.recordings;
        for (Recording& r : shifted) shift_readings(r, channels_of(of).names, seconds);
        return estimate_of(test.study, shifted, filter, BatchOptions::Result::estimates);
      },
      interval, inference::SiteLimits::promise);
  return found && found->evident() && (found->explains() || found->alone()) ? found : std::nullopt;
}

double usual_interval(const std::vector<Recording>& recorded) {
  std::vector<double> usual;
  for (const Recording& r : recorded)
    for (const double step : row_spacing(r).usual)
      if (std::isfinite(step)) usual.push_back(step);
  return usual.empty() ? 0.0 : stats::median(std::move(usual));
}

void DelayDoubt::weigh(double chi2_above) {
  const double every_size = 2.0 * std::log(longest / shortest);
  if (sigma > 0.0)
    log_evidence = 0.5 * chi2_above + 0.5 * std::log(2.0 * std::numbers::pi) +
                   std::log(sigma / std::max(std::abs(late), sigma)) - std::log(every_size);
}

bool DelayDoubt::evident() const {
  return log_evidence + std::log(inference::SiteLimits::another) > 0.0;
}

bool DelayDoubt::explains() const {
  return chi2_per_dof_before - chi2_per_dof_after >=
         inference::SiteLimits::most * (chi2_per_dof_before - 1.0);
}

bool DelayDoubt::alone() const {
  return chance_after >= inference::SearchLimits::alpha;
}

bool DelayDoubt::momentary() const {
  return of == Of::accelerometers &&
         std::abs(late + 0.5 * interval) <
             std::max(as_estimated * sigma, 0.5 * short_mean * interval);
}

}  // namespace drift::identification
