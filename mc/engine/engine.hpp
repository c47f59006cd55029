#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/check.hpp"
#include "mc/engine/mpi_launch.hpp"
#include "mc/engine/work_session.hpp"
#include "mc/store/manifest.hpp"
#include "mc/store/stored_block.hpp"
#include "mc/task/run_task.hpp"

namespace drift::mc {

struct EngineOptions {
  std::uint64_t runs = 100;             ///< per study point
  std::uint64_t allowed_failures = 0;   ///< runs of the whole study that may fail
  int threads = 0;                      ///< 0: all
  WorkerShare share = {};               ///< ignored with several ranks
  std::optional<double> max_wall = {};  ///< [s] of the clock
  bool fail_fast = false;     ///< stop at the first failed run; no block with one is stored
  std::uint64_t shuffle = 0;  ///< not 0: take the blocks in this random order (for tests)
};

/// What is done so far, of the whole study: other workers' earlier runs and all ranks included.
struct Progress {
  std::uint64_t done = 0, total = 0, failed = 0;
  std::uint64_t done_now = 0;  ///< of `done`, those of this session
  bool at_most = false;        ///< `total` is: stop rules may end points before
  double elapsed = 0.0;        ///< of this session [s]
};

/// Called from one thread at a time, some times per second, and once at the end.
using ProgressSink = std::function<void(const Progress&)>;

/// How a session ended.
struct StudyOutcome {
  ExitCode code = ExitCode::ok;   ///< ok, failed_runs, io, wall_time, interrupted, terminated
  bool complete = false;          ///< every block of the study is stored
  bool leader = true;             ///< this process speaks for the study
  std::uint64_t done_before = 0;  ///< runs found in the folder, of those asked for
  std::uint64_t cut_short =
      0;  ///< runs found in blocks that the shorter study before ended within: done anew
  std::uint64_t stored_runs =
      0;  ///< per point, the most asked for so far; more than `runs`: results have them too
  std::uint64_t done = 0;  ///< runs executed in this session in blocks that it stored, all ranks
  std::uint64_t kept = 0;  ///< runs executed in blocks that were not completed: kept for the next
  std::uint64_t kept_before = 0;  ///< such that this session found, of this worker's share
  std::uint64_t taken_over = 0;   ///< of them those in blocks that it stored
  std::uint64_t kept_after = 0;   ///< such that are there at its end
  std::uint64_t dropped = 0;   ///< executed beside the run at which `fail_fast` stopped: not kept
  double longest_group = 0.0;  ///< of runs executed together, in this process [s]
  std::uint64_t failed = 0;  ///< failed runs: of all results if complete, else of blocks stored now
  std::uint64_t failed_now = 0;    ///< of the runs executed in this session, stored or not
  std::uint64_t results = 0;       ///< runs that count (complete studies)
  std::size_t missing = 0;         ///< blocks still to be done
  std::size_t missing_own = 0;     ///< of them, those of this worker's share
  double seconds = 0.0;            ///< of the clock, this session
  std::string digest;              ///< results_digest() (complete studies)
  std::vector<std::string> notes;  ///< damage found and mended; of other ranks what each mended
  /// The run at which `fail_fast` ended the session of this process. Its block is not stored.
  struct FailedRun {
    std::size_t point = 0;
    Failure failure;
  };
  std::optional<FailedRun> failed_first;
};

/// Executes what is missing of a study and stores it in a folder that claim_folder() accepted.
///
/// Runs go to the threads one by one, across blocks and points; a block is stored when its last run
/// is done. A failed run is a row and a cause. SIGINT and SIGTERM let the runs at work finish (a
/// second one ends the process at once: StopSignals), `max_wall` begins none that would not end in
/// time (but one of each session); runs of incomplete blocks are kept, and the study is resumed by
/// the same call. Results do not depend on threads, workers, ranks or interruptions. InputError: io
/// if the disk is full (resumable), self_check if two workers came to different results, config if
/// the own terms of another study have been read since (require_own_terms()).
StudyOutcome run_study(const StudyWork& work, const EngineOptions& options,
                       const std::string& folder, const Manifest& manifest, Ranks& ranks,
                       const ProgressSink& progress = {});

}  // namespace drift::mc
