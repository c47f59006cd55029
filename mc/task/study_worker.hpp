#pragma once

#include <memory>
#include <vector>

#include "core/estimate/batch.hpp"
#include "core/estimate/sequential/ekf.hpp"
#include "core/estimate/sequential/in_lanes/ekf_lanes.hpp"
#include "core/estimate/sequential/in_lanes/iterated_lanes.hpp"
#include "core/estimate/sequential/iterated_passes.hpp"
#include "core/sim/simulate.hpp"
#include "mc/study/design.hpp"
#include "mc/task/principal_axes.hpp"
#include "mc/task/study_task.hpp"

namespace drift::mc {

/// Executes runs of a study point on one thread. From the second run on, the filters allocate
/// nothing. Filters that can (LaneIntervals) estimate several runs in lock step.
class StudyWorker final : public RunWorker {
 public:
  explicit StudyWorker(const StudyTask& task);
  RunOutcome execute(std::uint64_t run, std::span<double> row) override;
  RunOutcome trace(std::uint64_t run, std::span<double> row, TraceSink& sink) override;
  void execute(std::span<RunWork> runs) override;

 private:
  /// A run of those that are executed together.
  struct Member {
    RunWork* work = nullptr;
    Simulation sim;
  };
  /// An estimator in lanes, and its jobs: of the members of a group, start after start.
  template <class Estimator, class Job>
  struct InLanes {
    std::unique_ptr<Estimator> estimator;  ///< null where it is not the study's
    std::vector<Job> jobs;
  };
  /// One filter and its workspace.
  struct Bench {
    const FilterSpec& spec;
    const StudyColumns::Filter& columns;
    std::vector<Theta> fixed_starts;  ///< starts that are the same in every run: the first ones
    std::unique_ptr<Ekf> ekf;         ///< of that estimator alone
    std::unique_ptr<IteratedPasses> iterated;
    InLanes<EkfLanes, EkfJob> ekf_lanes;
    InLanes<IteratedLanes, IteratedJob> iterated_lanes;
    std::vector<Eigen::Index> judged;  ///< states that the truth has a value for
    VecX error;                        ///< of those, in prior sigmas
    MatX covariance;                   ///< of those
    PrincipalAxes axes;

    bool in_lanes() const { return ekf_lanes.estimator || iterated_lanes.estimator; }
  };

  void execute_alone(Member& member);
  void execute_in_lanes(std::span<Member> members);
  template <class Estimator, class Job>
  void estimate_in_lanes(InLanes<Estimator, Job>& lanes, Bench& bench, std::span<Member> members);
  Theta start_of(const Bench& bench, std::uint64_t run, std::size_t start) const;
  void simulate(Member& member);
  void estimate(Bench& bench, std::size_t start, Member& member);
  template <class Filter>
  void write(Bench& bench, Filter& filter, std::size_t start, Member& member);
  void by_batch(Bench& bench, const Theta& from, std::size_t start, Member& member);
  /// Writes NEES of estimate x with covariance P, both in prior sigmas: of the states that the
  /// truth has a value for.
  template <class Vector, class Matrix>
  void judge(Bench& bench, std::size_t start, const Vector& x, const Matrix& P,
             std::span<double> row);

  const StudyTask& task_;
  Timeline timeline_;  ///< with the surroundings of the run
  Design design_;
  Simulator simulator_;
  TruthDraw draw_;
  std::vector<Member> members_;
  std::vector<Bench> benches_;
};

}  // namespace drift::mc
