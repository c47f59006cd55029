#include "analysis/identification/identify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "analysis/identification/absent_channels.hpp"
#include "analysis/identification/beyond_prior.hpp"
#include "analysis/identification/considered_field.hpp"
#include "analysis/identification/counted_start.hpp"
#include "analysis/identification/filter_run.hpp"
#include "analysis/identification/recording_names.hpp"
#include "analysis/inference/thresholds.hpp"
#include "analysis/preparation/prepare.hpp"
#include "analysis/preparation/recorded_test.hpp"
#include "core/base/check.hpp"
#include "core/base/memory.hpp"
#include "core/estimate/start_consistency.hpp"
#include "core/estimate/starts.hpp"
#include "core/physics/stochastic.hpp"
#include "core/plan/plan_memory.hpp"
#include "core/plan/plan_rows.hpp"
#include "core/sim/judged_truth.hpp"
#include "mc/study/own_terms_check.hpp"
#include "mc/study/own_terms_on_plan.hpp"
#include "mc/study/simulated_surroundings.hpp"
#include "mc/task/campaign.hpp"

namespace drift::identification {
namespace {

std::vector<Job> jobs_of(const mc::Study& study) {
  if (study.filters.empty())
    throw InputError(ExitCode::config,
                     fmt::format("{}: no [[filter]]: nothing to estimate with. Add a "
                                 "section [[filter]] with name and coupling",
                                 study.path));
  std::vector<Job> jobs;
  for (std::size_t f = 0; f < study.filters.size(); ++f)
    for (std::size_t s = 0; s < start_count(study.filters[f]); ++s) jobs.push_back({f, s});
  return jobs;
}

std::vector<FilterSummary> summarise(const mc::Study& study, const Identification& id) {
  std::vector<FilterSummary> all;
  for (std::size_t f = 0; f < study.filters.size(); ++f) {
    FilterSummary s;
    s.filter = f;
    s.name = study.filters[f].name;
    s.coupling = study.filters[f].coupling;
    s.layout = make_layout(study.filters[f]);
    const auto runs = id.runs_of(f);
    const CountedStart counted = counted_start(
        study.filters[f], runs, id.test_of_each_start ? Measured::by_each_start : Measured::once);
    s.counted_start = counted.start;
    s.agreeing_starts = counted.agreeing;
    for (std::size_t k = 0; k < s.layout.size(); ++k) {
      std::vector<double> ekf, ekf_sigma, batch, batch_sigma, as_good, as_good_sigma;
      for (const FilterRun* r : runs) {
        ekf.push_back(r->ekf.parameters[k].value);
        ekf_sigma.push_back(r->ekf.parameters[k].sigma);
        batch.push_back(r->batch.estimate.parameters[k].value);
        batch_sigma.push_back(r->batch.estimate.parameters[k].sigma);
      }
      for (const std::size_t start : counted.as_good) {
        as_good.push_back(batch[start]);
        as_good_sigma.push_back(batch_sigma[start]);
      }
      StartSpread spread{s.layout.params[k], start_consistency(ekf, ekf_sigma),
                         start_consistency(batch, batch_sigma)};
      spread.counted = drift_varies(study.filters[f]) ? spread.ekf
                       : as_good.size() > 1           ? start_consistency(as_good, as_good_sigma)
                                                      : std::nan("");
      s.spread.push_back(spread);
    }
    s.unseen = weak_directions(id.counted(s).batch.information_root, 1.0);
    s.weak = s.unseen.size();
    std::erase_if(s.unseen,
                  [](const WeakDirection& d) { return d.information >= unseen_information; });
    all.push_back(std::move(s));
  }
  return all;
}

/// ends: of each recording, the interval after its last.
std::vector<SampleOfTest> samples_of(const Timeline& timeline, const Readout& readout,
                                     const std::vector<std::size_t>& ends) {
  std::vector<SampleOfTest> samples;
  for (const Interval& i : timeline.intervals) {
    const auto recording = std::ranges::upper_bound(ends, samples.size()) - ends.begin();
    samples.push_back(
        {i.t1, i.position + 1, i.slew, i.accelerometer_noise(readout.accelerometer_noise),
         i.gimbal_noise(readout.gimbal_noise), static_cast<std::size_t>(recording) + 1});
  }
  return samples;
}

/// Every filter and start keeps its estimates and sigmas at every row.
void require_memory_for_histories(const mc::Study& study,
                                  const std::vector<Recording>& recordings) {
  double rows = 0.0, numbers = 0.0;
  for (const Recording& r : recordings) rows += static_cast<double>(r.rows());
  for (const Job& job : jobs_of(study))
    numbers += 2.0 * static_cast<double>(make_layout(study.filters[job.filter]).size());
  require_memory(memory_of_samples(rows) + rows * numbers * sizeof(double), ExitCode::recording,
                 fmt::format("{}: {:.0f} rows, estimated with every filter and start,",
                             recordings.front().source, rows),
                 "Average the rows to longer samples, or leave out filters or starts");
}

template <class Task>
void run_jobs(const mc::Study& study, Identification& id, int threads, const Progress& progress,
              Task&& task) {
  const std::vector<Job> jobs = jobs_of(study);
  std::atomic<std::size_t> done{0};
  id.runs = mc::run_campaign(
      jobs.size(),
      [&](std::size_t k) {
        FilterRun run = task(jobs[k]);
        const std::size_t count = ++done;
        if (progress) progress(count, jobs.size());
        return run;
      },
      threads);
}

/// All filters and starts of one test.
void estimate_all(const mc::Study& study, const MeasuredTest& test, Identification& id, int threads,
                  const Progress& progress) {
  const auto task = [&](const Job& job) {
    return estimate(study, job, test.timeline, test.measured);
  };
  run_jobs(study, id, threads, progress, task);
  take_over_closure(study, test, id.runs, threads);
  try_prior_means(study, id, [&](std::size_t filter, std::size_t start) {
    std::vector<FilterRun> one{task({filter, start})};
    take_over_closure(study, test, one, threads);
    return std::move(one.front());
  });
  id.summaries = summarise(study, id);
}

/// Where no filter fits, or fits with parameters that no prior of its has, headings or the latitude
/// may be behind it: most of a wrong one is drift that follows the attitude.
///
/// Before those, accelerometers and gimbals of different instants, where the first filter does not
/// fit: one that leaves nothing then is no other study. recorded: as they were read.
void doubt_study(const mc::Study& study, const std::vector<Recording>& recordings,
                 const std::vector<Recording>& recorded, Identification& id) {
  const auto result = [&](const FilterSummary& s) -> const EstimateResult& {
    return judged(study.filters[s.filter], id.counted(s));
  };
  constexpr auto d_lat = TermLibrary::index("d_lat");
  const auto fits = [&](const FilterSummary& s) {
    return !misfit(result(s)) && beyond_prior(result(s)).empty();
  };
  if (std::ranges::any_of(id.summaries, fits)) return;
  const FilterSummary& first = id.summaries.front();
  if (misfit(result(first)))
    if (const auto test = dwells_alone(study, recordings))
      id.delay = delay_of_misfit(*test, study.filters[first.filter], usual_interval(recorded));
  if (id.delay && id.delay->alone()) return;
  for (FilterSummary& s : id.summaries) {
    const FilterSpec& filter = study.filters[s.filter];
    s.heading_doubt = heading_doubt(study, recordings, filter);
    if (s.heading_doubt || filter.active[d_lat]) continue;
    s.latitude_doubt = latitude_doubt(study, recordings, filter);
    // What a fit that is one gains elsewhere may be chance, but for the other hemisphere.
    if (s.latitude_doubt && !s.latitude_doubt->mirrored && !misfit(result(s)))
      s.latitude_doubt.reset();
  }
}

/// How far chi-square over its degrees of freedom m, whose variance is 2/m, may be from 1.
double furthest_off(const EstimateResult& result) {
  return inference::FitLimits::misfit * std::sqrt(2.0 / static_cast<double>(result.measured));
}

}  // namespace

const EstimateResult& judged(const FilterSpec& filter, const FilterRun& run) {
  return drift_varies(filter) ? run.ekf : run.batch.estimate;
}

bool misfit(const EstimateResult& result) {
  return result.measured > 0 && result.statistic_per_dof() - 1.0 > furthest_off(result);
}

bool less_noise(const EstimateResult& result) {
  return result.measured > 0 && !result.noise_at_most &&
         1.0 - result.statistic_per_dof() > furthest_off(result);
}

double noise_of_declared(const FilterSpec& filter, const FilterRun& run) {
  const EstimateResult& result = judged(filter, run);
  double free = static_cast<double>(result.measured);
  for (const ParameterEstimate& p : result.parameters)
    free -= 1.0 - std::min(1.0, p.learning_ratio() * p.learning_ratio());
  // The part of the priors in chi-square does not become less with the noise.
  return !drift_varies(filter) && run.batch.data_chi2 > 0.0 && free >= 1.0
             ? std::sqrt(run.batch.data_chi2 / free)
             : std::sqrt(result.statistic_per_dof());
}

std::vector<const FilterRun*> Identification::runs_of(std::size_t filter) const {
  std::vector<const FilterRun*> found;
  for (const FilterRun& r : runs)
    if (r.filter == filter) found.push_back(&r);
  return found;
}

const FilterRun& Identification::counted(const FilterSummary& filter) const {
  return *runs_of(filter.filter)[filter.counted_start];
}

Identification identify_simulated(const mc::Study& study, std::uint64_t run, int threads,
                                  const Progress& progress) {
  mc::require_own_terms(study);
  if (!study.has_truth)
    throw InputError(
        ExitCode::config,
        fmt::format("{}: no [truth] to simulate from. Give a recording on the command line, "
                    "or add a section [truth]",
                    study.path));
  mc::require_simulable_models(study);
  Identification id;
  id.simulated = true;
  Timeline timeline = lay_out(study.plan, study.site);
  set_loop(timeline, study.truth);
  const std::uint64_t seed = study.monte_carlo.seed;
  set_environment(timeline, study.environment, seed, run);
  mc::resolve_own_terms(timeline, study);
  id.samples = samples_of(timeline, study.readout, {timeline.intervals.size()});
  id.excitation = excitation_of(timeline);
  const TruthDraw draw = draw_truth(study.truth, timeline.chains, seed, run);
  id.truth = draw;
  id.truth->theta = judged_truth(study.truth, draw.theta);
  if (study.truth.coupling == Coupling::compensated && study.truth.loop == LoopEstimate::feedback) {
    id.test_of_each_start = true;
    run_jobs(study, id, threads, progress,
             [&](const Job& job) { return estimate_in_the_loop(study, job, timeline, draw, run); });
    id.summaries = summarise(study, id);
    return id;
  }
  const Simulation sim = Simulator(study.truth, study.readout).run(timeline, draw, seed, run);
  require_ok(sim.ode, run);
  id.truth->theta = judged_truth(study.truth, sim.theta_end);  // of estimates at the end
  id.recordings = {make_recording(timeline, sim.measured, study.readout)};
  estimate_all(study, {timeline, study.readout, sim.measured}, id, threads, progress);
  return id;
}

Identification identify_recordings(const mc::Study& study, const std::vector<Recording>& recordings,
                                   int threads, const Progress& progress) {
  Identification id;
  for (const Recording& r : recordings) id.sources.push_back(r.source);
  const preparation::Prepared ready = preparation::prepare(study, recordings);
  id.recordings = ready.recordings;
  id.names = recording_names(ready.recordings);
  id.loop = stated_loop(ready.recordings);
  id.remarks = ready.remarks;
  id.off_zero = ready.off_zero;
  id.absent_positions = ready.absent_positions;
  for (const Recording& r : ready.recordings)
    if (r.samples.empty()) {  // left as they were
      const auto others = rows_other_than_planned(r, study.plan);
      id.remarks.insert(id.remarks.end(), others.begin(), others.end());
    }
  require_memory_for_histories(ready.study, ready.recordings);
  const preparation::RecordedTest test = preparation::recorded_test(ready.study, ready.recordings);
  id.samples = samples_of(test.timeline, ready.study.readout, test.ends);
  id.excitation = excitation_of(test.timeline);
  estimate_all(ready.study, {test.timeline, ready.study.readout, test.measured}, id, threads,
               progress);
  consider_field(ready.study, test, id);
  id.spikes = without_spikes(test.measured, test.timeline, ready.study.readout,
                             id.counted(id.summaries.front()).batch)
                  .spikes;
  id.absent = absent_channels(ready.recordings, ready.study.readout);
  if (late_labels(id.spikes) == 0) doubt_study(ready.study, ready.recordings, recordings, id);
  return id;
}

}  // namespace drift::identification
