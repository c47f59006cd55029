// Speed of a study: runs per second and core of the default study, alone and on all threads,
// against a run as it is written without driftscope (practice_run.hpp), on the same recordings.
// Both estimate with one pass of an EKF; what the study's own estimator costs beyond that is
// printed below. Exit code 8 if the estimates of the two differ by more than their tolerances
// allow.

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "bench/practice_run.hpp"
#include "bench/rows.hpp"
#include "core/estimate/sequential/ekf.hpp"
#include "core/estimate/starts.hpp"
#include "mc/task/campaign.hpp"
#include "mc/task/study_task.hpp"

namespace drift::bench {
namespace {

constexpr int rounds = 3;
constexpr std::uint64_t practice_runs = 2;  // per point and round: the slow side
constexpr std::uint64_t runs = 24;          // per point and round
constexpr double allowed_attitude = 0.02;   // [arcsec]: both integrators hold 0.004 and better
constexpr double allowed_estimate = 0.02;   // of a parameter, in posterior sigmas

double wall_time() {
  return omp_get_wtime();
}

struct Point {
  const mc::StudyPoint* point;
  const mc::StudyTask* task;
};

/// What `runs` runs of every point take on `threads` threads [s]: the clock's time and the CPU's.
struct Taken {
  double wall = 1e9, cpu = 1e9;
  double spread = 1.0;  ///< slowest over quickest of several, CPU
};

Taken ours(const std::vector<Point>& points, int threads) {
  const double start = wall_time(), cpu_start = cpu_time();
  for (const Point& p : points)
    mc::run_campaign(
        static_cast<std::size_t>(threads),
        [&](std::size_t thread) {
          const auto worker = p.task->worker();
          std::vector<double> row(p.task->columns().size());
          for (std::uint64_t k = thread; k < runs; k += static_cast<std::size_t>(threads)) {
            std::fill(row.begin(), row.end(), std::nan(""));
            worker->execute(k, row);
          }
          return 0;
        },
        threads);
  return {wall_time() - start, cpu_time() - cpu_start};
}

/// The best of both.
void keep_best(Taken& best, const Taken& now) {
  if (best.cpu < 1e9)
    best.spread = std::max(best.spread * best.cpu, now.cpu) / std::min(best.cpu, now.cpu);
  best.wall = std::min(best.wall, now.wall);
  best.cpu = std::min(best.cpu, now.cpu);
}

struct Practice {
  double seconds = 0.0, integration = 0.0;
  double attitude = 0.0;  ///< largest difference of attitude from ours [arcsec]
  double estimate = 0.0;  ///< largest difference of an estimate from ours, in posterior sigmas
};

/// The same runs as in common practice: CPU seconds, and how far the answers are from ours.
Practice practice(const std::vector<Point>& points) {
  Practice out;
  for (const Point& p : points) {
    const mc::Study& study = p.point->study;
    const Timeline& timeline = p.task->timeline();
    Simulator simulator(study.truth, study.readout);
    for (std::uint64_t k = 0; k < practice_runs; ++k) {
      const Simulation truth = simulator.run(timeline, study.monte_carlo.seed, k);
      const double start = cpu_time();
      const Trajectory phi = practice_trajectory(timeline, study.truth, truth.draw,
                                                 Simulator::default_options(study.truth.coupling));
      out.integration += cpu_time() - start;
      for (std::size_t n = 0; n < phi.size(); ++n)
        out.attitude = std::max(out.attitude, (phi[n] - truth.phi[n]).norm() / unit::arcsec.to_si);
      for (const FilterSpec& f : study.filters)
        for (std::size_t s = 0; s < start_count(f); ++s) {
          const Theta start_estimate = initial_estimate(f, study.monte_carlo.seed, s);
          const EstimateResult theirs =
              practice_ekf(f, timeline, study.readout, truth.measured, start_estimate);
          const double before = cpu_time();
          const EstimateResult own =
              run_ekf(f, {timeline, study.readout, truth.measured}, start_estimate);
          out.seconds -= cpu_time() - before;
          if (own.status != EstimateStatus::ok) continue;
          for (std::size_t i = 0; i < own.parameters.size(); ++i)
            out.estimate = std::max(out.estimate,
                                    std::abs(own.parameters[i].value - theirs.parameters[i].value) /
                                        own.parameters[i].sigma);
        }
      out.seconds += cpu_time() - start;
    }
  }
  return out;
}

/// The points of a study and what executes their runs.
struct Points {
  Points(const mc::Study& study, std::optional<mc::EstimatorKind> estimator)
      : points(mc::study_points(study)) {
    if (estimator)
      for (mc::StudyPoint& p : points) p.study.monte_carlo.estimator = *estimator;
    tasks = mc::study_tasks(points);
    for (std::size_t i = 0; i < points.size(); ++i)
      all.push_back({&points[i], dynamic_cast<const mc::StudyTask*>(tasks[i].task.get())});
  }
  std::vector<mc::StudyPoint> points;
  decltype(mc::study_tasks(points)) tasks;
  std::vector<Point> all;
};

int run(const char* file) {
  const mc::Study study = mc::read_study(file);
  const Points as_given(study, {}), one_pass(study, mc::EstimatorKind::ekf);
  const std::vector<Point>& all = one_pass.all;
  const int threads = omp_get_num_procs();
  Taken one, many, own;
  Practice other;
  other.seconds = 1e9;
  for (int k = 0; k < rounds; ++k) {
    keep_best(one, ours(all, 1));
    keep_best(many, ours(all, threads));
    keep_best(own, ours(as_given.all, 1));
    Practice now = practice(all);
    now.attitude = std::max(now.attitude, other.attitude);
    now.estimate = std::max(now.estimate, other.estimate);
    if (now.seconds > other.seconds) {
      now.seconds = other.seconds;
      now.integration = other.integration;
    }
    other = now;
  }
  const auto total = static_cast<double>(runs * all.size());
  const auto practised = static_cast<double>(practice_runs * all.size());
  fmt::print(
      "{}: {} points, {} filters; a run is one simulated test, every filter, every start; best of "
      "{}\n\n",
      file, all.size(), study.filters.size(), rounds);
  fmt::print("{:<44}{:>16}{:>12}\n", "", "runs/s of CPU", "ratio");
  const double base = practised / other.seconds;
  fmt::print("{:<44}{:>16.3f}{:>12.1f}\n", "packaged CVODE and dense EKF, one pass", base, 1.0);
  fmt::print("{:<44}{:>16.3f}{:>12.1f}\n", "driftscope, one pass", total / one.cpu,
             total / one.cpu / base);
  fmt::print("{:<44}{:>16.3f}\n", "driftscope, the study's own estimator", total / own.cpu);
  fmt::print("\n{} threads: {:.2f} times as fast by the clock, {:.1f} % more CPU time\n", threads,
             one.wall / many.wall, 100.0 * (many.cpu / one.cpu - 1.0));
  fmt::print("share of integration in the practice run: {:.1f} %\n",
             100.0 * other.integration / other.seconds);
  const double ours_run = one.cpu / total, iterated_run = own.cpu / total;
  print_row("run_one_pass", ours_run, other.seconds / practised, one.spread,
            "a run of the default study, one pass of the EKF, against packaged CVODE and a dense "
            "EKF with the same linearisation");
  print_row("run_iterated", iterated_run, other.seconds / practised, own.spread,
            "the study's iterated estimator against ONE pass of practice (practice does not "
            "iterate)");
  print_row("threads2", many.cpu / total, ours_run, many.spread,
            fmt::format("CPU time of a run on {} threads against one; by the clock {:.2f} times as "
                        "fast",
                        threads, one.wall / many.wall));
  fmt::print("largest differences: attitude {:.1e} arcsec, estimate {:.1e} posterior sigma\n",
             other.attitude, other.estimate);
  return other.attitude < allowed_attitude && other.estimate < allowed_estimate ? 0 : 8;
}

}  // namespace
}  // namespace drift::bench

int main(int argc, char** argv) {
  return drift::bench::run(argc > 1 ? argv[1] : "configs/study.toml");
}
