#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/base/units.hpp"

namespace drift::mc {

/// One number of the row that every run yields.
struct Column {
  std::string name;  ///< "eq5/0/sigma/D_I_z"
  Unit unit;         ///< in which people read it; rows themselves are SI
};

/// How a run ended. The numbers are stored: never renumber.
enum class RunStatus : std::uint8_t {
  ok = 0,
  integrator_failed = 1,
  filter_diverged = 2,
  nonfinite = 3,
  timeout = 4,
  error = 5,
};

/// What a run says of itself besides its row. Times of the clock are not part of the result.
struct RunOutcome {
  RunStatus status = RunStatus::ok;
  std::string cause;      ///< in words, empty if ok
  double t_failed = 0.0;  ///< time in the test at which it failed [s]
  double integration_s = 0.0, filter_s = 0.0, total_s = 0.0;  ///< CPU seconds spent
};

/// A run to be executed, and what came out of it.
struct RunWork {
  std::uint64_t run = 0;
  std::span<double> row;  ///< shape: columns of the task; comes full of NaN
  RunOutcome outcome;
};

/// Takes the course of one run, sample by sample, for people to look at.
class TraceSink {
 public:
  virtual ~TraceSink() = default;
  virtual void columns(const std::vector<Column>& columns) = 0;  ///< first, once
  virtual void row(std::span<const double> values) = 0;          ///< SI, shape: columns
};

/// Executes runs one after another; one per thread, keeps its workspace between runs.
class RunWorker {
 public:
  virtual ~RunWorker() = default;
  /// Executes run number `run` and fills `row` (shape: columns of the task), which comes full of
  /// NaN. A pure function of (task, run): what ran before leaves no trace. Failures are outcomes.
  virtual RunOutcome execute(std::uint64_t run, std::span<double> row) = 0;
  /// Executes several: what comes out of each is the same, bit for bit.
  virtual void execute(std::span<RunWork> runs) {
    for (RunWork& w : runs) w.outcome = execute(w.run, w.row);
  }
  /// The same as execute(), bit for bit, with the course of the run besides. A task without a trace
  /// leaves the sink untouched.
  virtual RunOutcome trace(std::uint64_t run, std::span<double> row, TraceSink& /*sink*/) {
    return execute(run, row);
  }
};

/// What is done in every run of one study point.
class RunTask {
 public:
  virtual ~RunTask() = default;
  virtual const std::vector<Column>& columns() const = 0;
  virtual std::unique_ptr<RunWorker> worker() const = 0;
  /// How many runs it pays to execute together.
  virtual std::size_t together() const { return 1; }
};

/// One point of a study: a task and what tells it from the others.
struct TaskPoint {
  std::string label;  ///< "truth.coupling = eq5, plan.preset = six"; empty without a sweep
  std::unique_ptr<RunTask> task;
};

/// A run of consecutive results as they are stored: runs first .. first + status.size() - 1.
struct Block {
  std::size_t point = 0;          ///< index of the study point
  std::uint64_t first = 0;        ///< number of the first run
  std::vector<RunStatus> status;  ///< one per run
  std::vector<double> rows;       ///< row-major, shape (runs, columns), SI
};

/// Decides from results whether enough runs are done; fed block after block in order.
class StopRule {
 public:
  virtual ~StopRule() = default;
  /// Takes in the next block of a point; true if the point needs no more runs.
  virtual bool enough(const Block& block) = 0;
};

/// Makes the stop rule of a study point; none: all runs are done.
using StopRules = std::function<std::unique_ptr<StopRule>(std::size_t point)>;

/// What a study file asks for, ready to be executed.
struct StudyWork {
  std::vector<TaskPoint> points;
  StopRules stop_rules;  ///< may be empty
};

}  // namespace drift::mc
