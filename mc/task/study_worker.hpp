#pragma once

#include <memory>
#include <vector>

#include "core/estimate/batch.hpp"
#include "core/estimate/sequential/ekf.hpp"
#include "core/estimate/sequential/iterated_ekf.hpp"
#include "core/sim/simulate.hpp"
#include "mc/study/design.hpp"
#include "mc/task/principal_axes.hpp"
#include "mc/task/study_task.hpp"

namespace drift::mc {

/// Executes runs of a study point on one thread. From the second run on, the filters allocate
/// nothing.
class StudyWorker final : public RunWorker {
 public:
  explicit StudyWorker(const StudyTask& task);
  RunOutcome execute(std::uint64_t run, std::span<double> row) override;
  RunOutcome trace(std::uint64_t run, std::span<double> row, TraceSink& sink) override;

 private:
  /// One filter and its workspace.
  struct Bench {
    const FilterSpec& spec;
    const StudyColumns::Filter& columns;
    std::vector<Theta> fixed_starts;  ///< starts that are the same in every run: the first ones
    std::unique_ptr<Ekf> ekf;         ///< of that estimator alone
    std::unique_ptr<IteratedEkf> iterated;
    PrincipalAxes axes;
    VecX error;  ///< in prior sigmas
  };

  void simulate(std::uint64_t run, std::span<double> row, RunOutcome& out);
  void estimate(Bench& bench, std::uint64_t run, std::size_t start, std::span<double> row,
                RunOutcome& out);
  template <class Filter>
  void write(Bench& bench, Filter& filter, std::size_t start, std::span<double> row,
             RunOutcome& out);
  void by_batch(Bench& bench, const Theta& from, std::size_t start, std::span<double> row,
                RunOutcome& out);
  /// Writes NEES of estimate x with covariance P, both in prior sigmas.
  template <class Vector, class Matrix>
  void judge(Bench& bench, std::size_t start, const Vector& x, const Matrix& P,
             std::span<double> row);

  const StudyTask& task_;
  Timeline timeline_;  ///< with the surroundings of the run
  Design design_;
  Simulator simulator_;
  TruthDraw draw_;
  Simulation sim_;
  std::vector<Bench> benches_;
};

}  // namespace drift::mc
