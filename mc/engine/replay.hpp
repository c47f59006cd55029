#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "mc/store/study_reader.hpp"
#include "mc/task/run_task.hpp"

namespace drift::mc {

/// A run executed again, beside what is stored of it.
struct Replay {
  RunOutcome outcome;
  std::vector<double> row;
  bool stored = false;   ///< the folder has this run
  bool damaged = false;  ///< it had: what is listed cannot be read
  RunStatus stored_status = RunStatus::ok;
  std::vector<double> stored_row;
  bool same = false;  ///< status and every bit of the row
};

/// Executes run `run` of a study point again, with its course going to `trace` unless null.
Replay replay(const RunTask& task, StudyReader& reader, std::size_t point, std::uint64_t run,
              TraceSink* trace);

/// What a check of a folder found.
struct Verification {
  std::size_t blocks = 0, copies = 0;
  std::size_t missing = 0;  ///< blocks that are not there, or damaged in every copy
  std::uint64_t runs = 0, recomputed = 0;
  std::vector<std::string> damage;  ///< results that are lost, or files whose structure is damaged
  std::vector<std::string> notes;   ///< damage of which an undamaged copy exists
  std::vector<std::string> mismatch;  ///< results that do not come out again
  std::string digest;
};

/// Verifies every checksum and every duplicate, and executes a share of the runs again (0..1, at
/// least one run of every point unless 0) to compare every bit. The choice of runs is always the
/// same.
Verification verify(const StudyWork& work, StudyReader& reader, double sample, int threads);

}  // namespace drift::mc
