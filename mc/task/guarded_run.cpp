#include "mc/task/guarded_run.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace drift::mc {
namespace {

constexpr std::array by_gravity{ExitCode::ok,          ExitCode::failed_runs, ExitCode::wall_time,
                                ExitCode::interrupted, ExitCode::terminated,  ExitCode::usage,
                                ExitCode::config,      ExitCode::recording,   ExitCode::store,
                                ExitCode::self_check,  ExitCode::io,          ExitCode::internal};

}  // namespace

RunOutcome guarded_run(RunWorker& worker, std::uint64_t run, std::span<double> row,
                       TraceSink* trace) {
  RunOutcome outcome;
  try {
    return trace != nullptr ? worker.trace(run, row, *trace) : worker.execute(run, row);
  } catch (const InputError& error) {
    // A trace that cannot be written, or may not replace what is there.
    if (trace != nullptr && (error.code() == ExitCode::io || error.code() == ExitCode::store))
      throw;
    outcome.cause = error.what();
  } catch (const std::exception& error) {
    outcome.cause = error.what();
  } catch (...) {
    outcome.cause = "an exception that is no std::exception";
  }
  outcome.status = RunStatus::error;
  std::fill(row.begin(), row.end(), std::numeric_limits<double>::quiet_NaN());
  return outcome;
}

void guarded_runs(RunWorker& worker, std::span<RunWork> runs) {
  if (runs.size() > 1) {
    try {
      return worker.execute(runs);
    } catch (...) {  // whose fault it is shows below
    }
  }
  for (RunWork& w : runs) {
    std::ranges::fill(w.row, std::numeric_limits<double>::quiet_NaN());
    w.outcome = guarded_run(worker, w.run, w.row);
  }
}

int gravity(ExitCode code) {
  return static_cast<int>(std::find(by_gravity.begin(), by_gravity.end(), code) -
                          by_gravity.begin());
}

ExitCode of_gravity(int gravity) {
  return by_gravity.at(static_cast<std::size_t>(gravity));
}

ExitCode code_of(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const InputError& e) {
    return e.code();
  } catch (...) {
    return ExitCode::internal;
  }
}

}  // namespace drift::mc
