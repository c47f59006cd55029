#pragma once

#include <exception>
#include <span>

#include "core/base/check.hpp"
#include "mc/task/run_task.hpp"

namespace drift::mc {

/// Executes one run, with its course going to `trace` unless null. Whatever is thrown becomes an
/// outcome, the row NaN; only an InputError of a trace that cannot be written there is passed on.
RunOutcome guarded_run(RunWorker& worker, std::uint64_t run, std::span<double> row,
                       TraceSink* trace = nullptr);

/// Executes several together, and where anything is thrown each by itself.
void guarded_runs(RunWorker& worker, std::span<RunWork> runs);

/// Exit codes by how much they matter, so that several processes can agree on one.
int gravity(ExitCode code);
ExitCode of_gravity(int gravity);

/// What main() would answer to this exception.
ExitCode code_of(const std::exception_ptr& error);

}  // namespace drift::mc
