#include "mc/task/study_worker.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

#include "core/estimate/closure/closure_posterior.hpp"
#include "core/estimate/starts.hpp"
#include "core/plan/environment.hpp"
#include "core/sim/judged_truth.hpp"
#include "mc/task/trace.hpp"

namespace drift::mc {
namespace {

/// CPU time of this thread [s].
double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

RunStatus status_of(const OdeResult& ode) {
  if (ode.status == OdeStatus::sample_nonfinite) return RunStatus::nonfinite;
  return ode.status == OdeStatus::wall_time ? RunStatus::timeout : RunStatus::integrator_failed;
}

/// The first thing that goes wrong names the run.
void blame(RunOutcome& out, RunStatus status, std::string cause, double t) {
  if (out.status != RunStatus::ok) return;
  out.status = status;
  out.cause = std::move(cause);
  out.t_failed = t;
}

/// States of a filter that the truth has a value for.
std::vector<Eigen::Index> judged_states(const TruthSpec& truth, const Layout& layout) {
  const Theta values = judged_truth(truth, Theta::Zero());
  std::vector<Eigen::Index> states;
  for (std::size_t k = 0; k < layout.size(); ++k)
    if (!std::isnan(values[static_cast<Eigen::Index>(layout.params[k])]))
      states.push_back(static_cast<Eigen::Index>(k));
  return states;
}

void fail(RunWork& work, const std::exception& e) {
  std::ranges::fill(work.row, std::numeric_limits<double>::quiet_NaN());
  work.outcome.status = RunStatus::error;
  work.outcome.cause = e.what();
}

}  // namespace

StudyWorker::StudyWorker(const StudyTask& task)
    : task_(task),
      timeline_(task.timeline()),
      design_(task.study().truth, task.study().monte_carlo.design, task.study().monte_carlo.runs,
              task.study().monte_carlo.seed),
      simulator_(task.study().truth, task.study().readout) {
  const Study& study = task.study();
  for (std::size_t f = 0; f < study.filters.size(); ++f) {
    const FilterSpec& spec = study.filters[f];
    const StudyColumns::Filter& columns = task.layout().filters[f];
    std::vector<Eigen::Index> judged = judged_states(study.truth, columns.layout);
    const Eigen::Index n = std::ssize(judged);
    Bench bench{spec, columns,           {},      nullptr,    nullptr,         {},
                {},   std::move(judged), VecX(n), MatX(n, n), PrincipalAxes(n)};
    const std::size_t fixed = spec.starts.empty() ? 1 : columns.starts;
    for (std::size_t s = 0; s < fixed; ++s)
      bench.fixed_starts.push_back(initial_estimate(spec, study.monte_carlo.seed, 0, s));
    const Theta& start = bench.fixed_starts[0];
    const bool lanes = task.goes_in_lanes(spec);
    if (study.monte_carlo.estimator == EstimatorKind::ekf) {
      if (lanes)
        bench.ekf_lanes.estimator = std::make_unique<EkfLanes>(spec, timeline_, study.readout);
      else
        bench.ekf = std::make_unique<Ekf>(spec, timeline_, study.readout, start, KeepHistory::no);
    }
    if (study.monte_carlo.estimator == EstimatorKind::iterated) {
      if (lanes)
        bench.iterated_lanes.estimator =
            std::make_unique<IteratedLanes>(spec, timeline_, study.readout);
      else
        bench.iterated = std::make_unique<IteratedPasses>(spec, timeline_, study.readout, start);
    }
    benches_.push_back(std::move(bench));
  }
}

RunOutcome StudyWorker::execute(std::uint64_t run, std::span<double> row) {
  RunWork work{run, row, {}};
  execute(std::span(&work, 1));
  return work.outcome;
}

/// Each by itself as far as it goes, then in lanes.
void StudyWorker::execute(std::span<RunWork> runs) {
  if (members_.size() < runs.size()) members_.resize(runs.size());
  const auto members = std::span(members_).first(runs.size());
  for (std::size_t k = 0; k < runs.size(); ++k) {
    runs[k].outcome = RunOutcome();
    members[k].work = &runs[k];
    execute_alone(members[k]);
  }
  if (std::ranges::none_of(benches_, &Bench::in_lanes)) return;
  const double begin = cpu_seconds();
  execute_in_lanes(members);
  const double share = (cpu_seconds() - begin) / static_cast<double>(runs.size());
  for (RunWork& w : runs) {
    w.outcome.filter_s += share;
    w.outcome.total_s += share;
  }
}

void StudyWorker::execute_alone(Member& member) {
  RunOutcome& out = member.work->outcome;
  const double begin = cpu_seconds();
  double simulated = begin;
  try {
    simulate(member);
    simulated = cpu_seconds();
    const bool usable = out.status == RunStatus::ok;
    for (Bench& bench : benches_)
      for (std::size_t s = 0; usable && !bench.in_lanes() && s < bench.columns.starts; ++s)
        estimate(bench, s, member);
  } catch (const std::exception& e) {
    fail(*member.work, e);
  }
  const double end = cpu_seconds();
  out.integration_s = simulated - begin;
  out.filter_s = end - simulated;
  out.total_s = end - begin;
}

void StudyWorker::execute_in_lanes(std::span<Member> members) {
  try {
    for (Bench& bench : benches_) {
      estimate_in_lanes(bench.ekf_lanes, bench, members);
      estimate_in_lanes(bench.iterated_lanes, bench, members);
    }
  } catch (const std::exception& e) {
    if (members.size() > 1) throw;  // whose fault it is shows when each is executed by itself
    fail(*members[0].work, e);
  }
}

/// Every start of every member whose data are of use.
template <class Estimator, class Job>
void StudyWorker::estimate_in_lanes(InLanes<Estimator, Job>& lanes, Bench& bench,
                                    std::span<Member> members) {
  if (!lanes.estimator) return;
  std::vector<Job>& jobs = lanes.jobs;
  const std::size_t starts = bench.columns.starts;
  if (jobs.size() < members.size() * starts) jobs.resize(members.size() * starts);
  const auto usable = [](const Member& m) {
    const RunStatus status = m.work->outcome.status;
    return status == RunStatus::ok || status == RunStatus::filter_diverged;
  };
  std::size_t count = 0;
  for (const Member& m : members)
    for (std::size_t s = 0; s < starts && usable(m); ++s) {
      jobs[count].measured = &m.sim.measured;
      jobs[count++].start = start_of(bench, m.work->run, s);
    }
  lanes.estimator->run(std::span(jobs).first(count));
  count = 0;
  for (Member& m : members) {
    const bool has_jobs = usable(m);
    for (std::size_t s = 0; s < starts && has_jobs; ++s) write(bench, jobs[count++], s, m);
  }
}

void StudyWorker::simulate(Member& member) {
  const Study& study = task_.study();
  Simulation& sim = member.sim;
  const std::uint64_t run = member.work->run;
  if (study.environment.fluctuates())
    set_environment(timeline_, study.environment, study.monte_carlo.seed, run);
  design_.draw(run, timeline_.chains, draw_);
  simulator_.run(timeline_, draw_, study.monte_carlo.seed, run, sim);
  sim.theta_end = judged_truth(study.truth, sim.theta_end);  // of estimates at the end
  const auto& truth = task_.layout().truth;
  for (std::size_t c = 0; c < truth.size(); ++c)
    member.work->row[c] = sim.theta_end[static_cast<Eigen::Index>(truth[c])];
  if (!sim.ode.ok()) blame(member.work->outcome, status_of(sim.ode), sim.ode.cause, sim.ode.t);
}

Theta StudyWorker::start_of(const Bench& bench, std::uint64_t run, std::size_t start) const {
  return start < bench.fixed_starts.size()
             ? bench.fixed_starts[start]
             : initial_estimate(bench.spec, task_.study().monte_carlo.seed, run, start);
}

void StudyWorker::estimate(Bench& bench, std::size_t start, Member& member) {
  const Theta from = start_of(bench, member.work->run, start);
  const Measurements& measured = member.sim.measured;
  if (bench.ekf) {
    Ekf& ekf = *bench.ekf;
    ekf.reset(from);
    const auto intervals = static_cast<Eigen::Index>(timeline_.intervals.size());
    for (Eigen::Index i = 0; i < intervals && ekf.status() == EstimateStatus::ok; ++i)
      ekf.process(static_cast<std::size_t>(i), measured.acc.col(i), measured.gimbal.col(i));
    write(bench, ekf, start, member);
  } else if (bench.iterated) {
    write(bench, bench.iterated->run(measured, from), start, member);
  } else {
    by_batch(bench, from, start, member);
  }
}

template <class Filter>
void StudyWorker::write(Bench& bench, Filter& filter, std::size_t start, Member& member) {
  using C = StudyColumns;
  const std::span<double> row = member.work->row;
  const C::Filter& at = bench.columns;
  row[at.at(start, C::status)] = static_cast<double>(filter.status());
  if (filter.status() != EstimateStatus::ok) {
    blame(member.work->outcome, RunStatus::filter_diverged, at.name + ": " + filter.cause(),
          filter.t_diverged());
    return;
  }
  row[at.at(start, C::nis)] = filter.nis();
  row[at.at(start, C::nis_dof)] = static_cast<double>(filter.scalars());
  row[at.at(start, C::lag1)] = filter.lag1();
  for (std::size_t k = 0; k < at.layout.size(); ++k) {
    row[at.estimate(start, k)] = filter.theta()[static_cast<Eigen::Index>(at.layout.params[k])];
    row[at.sigma(start, k)] = filter.sigma(k);
  }
  judge(bench, start, filter.x(), filter.settled_covariance(), row);
}

void StudyWorker::by_batch(Bench& bench, const Theta& from, std::size_t start, Member& member) {
  using C = StudyColumns;
  const std::span<double> row = member.work->row;
  RunOutcome& out = member.work->outcome;
  const MeasuredTest test{timeline_, task_.study().readout, member.sim.measured};
  const EstimateResult e = over_closure(bench.spec, test, fit_batch(bench.spec, test, from));
  const C::Filter& at = bench.columns;
  row[at.at(start, C::status)] = static_cast<double>(e.status);
  if (e.status != EstimateStatus::ok) {
    blame(out, RunStatus::filter_diverged, at.name + ": " + e.cause, 0.0);
    return;
  }
  row[at.at(start, C::nis)] = e.statistic;
  row[at.at(start, C::nis_dof)] = static_cast<double>(e.measured);
  VecX x(static_cast<Eigen::Index>(at.layout.size()));
  for (std::size_t k = 0; k < at.layout.size(); ++k) {
    const ParameterEstimate& p = e.parameters[k];
    row[at.estimate(start, k)] = p.value;
    row[at.sigma(start, k)] = p.sigma;
    x[static_cast<Eigen::Index>(k)] = (p.value - p.prior_mean) / p.prior_sigma;
  }
  judge(bench, start, x, e.covariance, row);
}

template <class Vector, class Matrix>
void StudyWorker::judge(Bench& bench, std::size_t start, const Vector& x, const Matrix& P,
                        std::span<double> row) {
  using C = StudyColumns;
  const C::Filter& at = bench.columns;
  Eigen::Index n = 0;
  for (const Eigen::Index k : bench.judged) {
    const double truth = row[at.truth[static_cast<std::size_t>(k)]];
    bench.error[n] = x[k] - (truth - at.layout.mean[k]) / at.layout.sigma[k];
    Eigen::Index m = 0;
    for (const Eigen::Index l : bench.judged) bench.covariance(n, m++) = P(k, l);
    ++n;
  }
  if (n == 0) return;
  if (!bench.axes.compute(bench.covariance, bench.error)) return;  // NaN is told as missing
  const VecX &variances = bench.axes.variance(), &along = bench.axes.along();
  const double observed = std::pow(task_.study().monte_carlo.healthy_sigma, 2);
  double nees = 0.0, all = 0.0;
  int dof = 0;
  for (Eigen::Index j = 0; j < along.size(); ++j) {
    const double variance = variances[j];
    const double share = along[j] * along[j] / variance;
    all += share;
    if (variance >= observed) continue;
    nees += share;
    ++dof;
  }
  row[at.at(start, C::nees)] = nees;
  row[at.at(start, C::nees_dof)] = dof;
  row[at.at(start, C::nees_all)] = all;
}

RunOutcome StudyWorker::trace(std::uint64_t run, std::span<double> row, TraceSink& sink) {
  send_trace(trace_run(task_.study(), run), sink);
  return execute(run, row);
}

}  // namespace drift::mc
