#include "analysis/identification/filter_run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/inference/misalignments.hpp"
#include "core/base/check.hpp"
#include "core/estimate/closure/closure_posterior.hpp"
#include "core/estimate/starts.hpp"
#include "core/physics/stochastic.hpp"
#include "mc/task/campaign.hpp"

namespace drift::identification {
namespace {

/// Where a job starts: as the study says, and beyond its starts at the prior mean.
Theta start_of(const mc::Study& study, const Job& job) {
  const FilterSpec& filter = study.filters[job.filter];
  return job.start < start_count(filter)
             ? initial_estimate(filter, study.monte_carlo.seed, job.start)
             : make_layout(filter).theta;
}

/// Whether the EKF of the same readings ended lower than the fit by so much that this one is in
/// another valley: of what is linear they end alike. A fit knows no drift that varies.
bool ended_lower(const FilterSpec& filter, const EstimateResult& ekf, const EstimateResult& fit) {
  constexpr double clearly = 4.0;  // of chi-square: two sigma
  return ekf.status == EstimateStatus::ok && ekf.measured == fit.measured &&
         !drift_varies(filter) && ekf.statistic < fit.statistic - clearly;
}

/// The estimate over all of lambda, with an evidence that compares to other filters'.
EstimateResult whole_estimate(const FilterSpec& filter, const MeasuredTest& test,
                              const BatchResult& fit) {
  const Layout layout = make_layout(filter);
  return over_closure(filter, test, fit, [&](const VecX& x, const MatX& covariance) {
    return inference::log_gain_of_misalignments(layout, x, covariance);
  });
}

void fit_by_batch(FilterRun& run, const FilterSpec& filter, const MeasuredTest& test,
                  const Theta& start) {
  run.batch = fit_batch(filter, test, start);
  if (ended_lower(filter, run.ekf, run.batch.estimate)) {
    Theta there = make_layout(filter).theta;
    for (const ParameterEstimate& p : run.ekf.parameters)
      there[static_cast<Eigen::Index>(p.param)] = p.value;
    BatchResult other = fit_batch(filter, test, there);
    if (other.estimate.statistic < run.batch.estimate.statistic) run.batch = std::move(other);
  }
  run.memory_doubt = memory_doubt(filter, run.batch, test.timeline);
  run.memory_gaps = memory_gaps(filter, run.batch, test.timeline);
}

}  // namespace

FilterRun estimate(const mc::Study& study, const Job& job, const Timeline& timeline,
                   const Measurements& measured) {
  const FilterSpec& filter = study.filters[job.filter];
  const Theta start = start_of(study, job);
  FilterRun run;
  run.filter = job.filter;
  run.start = job.start;
  run.ekf = run_ekf(filter, {timeline, study.readout, measured}, start, &run.history);
  fit_by_batch(run, filter, {timeline, study.readout, measured}, start);
  for (EstimateResult* result : {&run.ekf, &run.batch.estimate})
    result->noise_at_most = study.readout.accelerometers_rounded || study.readout.gimbals_rounded;
  return run;
}

void take_over_closure(const mc::Study& study, const MeasuredTest& test,
                       std::vector<FilterRun>& runs, int threads) {
  std::vector<std::vector<std::size_t>> alike;  // runs, by the point where they ended
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (runs[k].batch.estimate.find(closure_param) == nullptr) continue;
    const auto group = std::ranges::find_if(alike, [&](const std::vector<std::size_t>& g) {
      const FilterRun& first = runs[g.front()];
      return first.filter == runs[k].filter && ended_at_one_point(first.batch, runs[k].batch);
    });
    if (group == alike.end())
      alike.push_back({k});
    else
      group->push_back(k);
  }
  const std::vector<EstimateResult> over = mc::run_campaign(
      alike.size(),
      [&](std::size_t g) {
        const FilterRun& first = runs[alike[g].front()];
        return whole_estimate(study.filters[first.filter], test, first.batch);
      },
      threads);
  for (std::size_t g = 0; g < alike.size(); ++g)
    for (const std::size_t k : alike[g])
      runs[k].batch.estimate = with_moments_of(over[g], runs[k].batch);
}

void require_ok(const OdeResult& ode, std::uint64_t run) {
  if (!ode.ok())
    throw InputError(
        ExitCode::self_check,
        fmt::format("simulation of run {} failed at t = {:.6g} s: {} ({}). The truth may be "
                    "unphysical: see `driftscope check`",
                    run, ode.t, name(ode.status), ode.cause));
}

FilterRun estimate_in_the_loop(const mc::Study& study, const Job& job, Timeline timeline,
                               const TruthDraw& draw, std::uint64_t run_number) {
  constexpr auto eta = TermLibrary::index("eta_x");
  const FilterSpec& filter = study.filters[job.filter];
  const Theta start = initial_estimate(filter, study.monte_carlo.seed, job.start);
  Simulator simulator(study.truth, study.readout);
  Simulation sim;
  simulator.begin(timeline, draw, study.monte_carlo.seed, run_number, sim);
  Ekf ekf(filter, timeline, study.readout, start);
  for (std::size_t first = 0; first < timeline.intervals.size();) {
    std::size_t end = first;
    while (end < timeline.intervals.size() &&
           timeline.intervals[end].position == timeline.intervals[first].position)
      timeline.intervals[end++].loop = ekf.theta().segment<6>(eta);
    simulator.extend(timeline, first, end, sim);
    require_ok(sim.ode, run_number);
    for (std::size_t i = first; i < end; ++i)
      ekf.process(i, sim.measured.acc.col(i), sim.measured.gimbal.col(i));
    first = end;
  }
  FilterRun run;
  run.filter = job.filter;
  run.start = job.start;
  run.ekf = ekf.result();
  run.history = ekf.history();
  const MeasuredTest test{timeline, study.readout, sim.measured};
  fit_by_batch(run, filter, test, start);
  run.batch.estimate = whole_estimate(filter, test, run.batch);
  return run;
}

}  // namespace drift::identification
