#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "mc/engine/work_session.hpp"

namespace drift::cli {

/// What a command takes whose work several processes may share, each for a limited time.
struct Sharing {
  std::string worker;    ///< "i/n", "auto"
  std::string max_wall;  ///< "55m"

  /// All of the work where no part is asked for. InputError (usage).
  mc::WorkerShare share() const;
  std::optional<double> seconds() const;
  /// One that begins at this moment, on the usual number of threads.
  mc::WorkSession session() const;
  bool is_asked_for() const { return !worker.empty() || !max_wall.empty(); }
  /// Where no part is asked for, as require_one_task().
  void require_part(const std::string& advice) const;
};

/// InputError (usage) if a launcher (srun, mpirun) has started several processes of this program
/// that would each do everything; `advice` says what to do.
void require_one_task(const std::string& advice);

/// --worker and --max-wall.
void add_sharing(CLI::App& app, Sharing& sharing);

}  // namespace drift::cli
