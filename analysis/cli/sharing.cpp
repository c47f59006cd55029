#include "analysis/cli/sharing.hpp"

#include <fmt/format.h>

#include "analysis/cli/argument_checks.hpp"
#include "analysis/cli/run_options.hpp"
#include "core/base/check.hpp"
#include "mc/engine/batch_system.hpp"

namespace drift::cli {

mc::WorkerShare Sharing::share() const {
  return worker.empty() ? mc::WorkerShare{} : parse_share(worker);
}

std::optional<double> Sharing::seconds() const {
  if (max_wall.empty()) return std::nullopt;
  return parse_duration("--max-wall", max_wall);
}

mc::WorkSession Sharing::session() const {
  return {.share = share(), .time = mc::WallTime(seconds())};
}

void Sharing::require_part(const std::string& advice) const {
  if (worker.empty()) require_one_task(advice);
}

void require_one_task(const std::string& advice) {
  const mc::Launch launch = mc::launch_of(mc::process_variable);
  if (launch.tasks <= 1) return;
  throw InputError(
      ExitCode::usage,
      fmt::format("{} has started {} tasks that know nothing of each other: each would do the "
                  "whole study (expected one task, MPI, or a part for each). {}; where each task "
                  "has work of its own, start it with `env -u {}`",
                  launch.by, launch.tasks, advice, launch.variable));
}

void add_sharing(CLI::App& app, Sharing& sharing) {
  app.add_option(
         "--worker", sharing.worker,
         "do part i of n of the study, i = 0 .. n - 1; auto: what Slurm, SGE, PBS or mpiexec says")
      ->check(check_given)
      ->type_name("I/N|auto");
  app.add_option("--max-wall", sharing.max_wall,
                 "stop after this time, resumable: 55m, 1h30m; a number alone is seconds")
      ->check(check_given)
      ->type_name("TIME");
}

}  // namespace drift::cli
