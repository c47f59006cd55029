#include "mc/engine/batch_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>

#include "core/base/check.hpp"

namespace drift::mc {
namespace {

std::optional<std::size_t> whole_number(std::string_view text) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

[[noreturn]] void refuse(std::string_view given, const std::string& why) {
  throw InputError(
      ExitCode::usage,
      fmt::format("--worker {}: {} (expected the variables of an array of Slurm, SGE or PBS, of "
                  "srun or of mpiexec). Give --worker i/n, or auto/n with the number of tasks",
                  given, why));
}

/// One way in which a batch system numbers the tasks of an array.
struct ArrayVariables {
  const char* task;
  const char* first;
  const char* last;
  const char* step;
};
constexpr ArrayVariables systems[] = {
    {"SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_MIN", "SLURM_ARRAY_TASK_MAX",
     "SLURM_ARRAY_TASK_STEP"},
    {"SGE_TASK_ID", "SGE_TASK_FIRST", "SGE_TASK_LAST", "SGE_TASK_STEPSIZE"},
    {"PBS_ARRAY_INDEX", nullptr, nullptr, nullptr},
    {"PBS_ARRAYID", nullptr, nullptr, nullptr},
};

}  // namespace

std::optional<std::string> process_variable(const std::string& name) {
  const char* value = std::getenv(name.c_str());
  return value == nullptr ? std::nullopt : std::optional<std::string>(value);
}

Launch launch_of(const ProcessVariables& environment) {
  // mpirun within a job of Slurm is started by srun on each machine: what it says itself comes
  // first.
  constexpr Launch launchers[] = {{1, "mpirun", "OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"},
                                  {1, "srun", "SLURM_STEP_NUM_TASKS", "SLURM_PROCID"},
                                  {1, "mpiexec", "PMI_SIZE", "PMI_RANK"}};
  for (Launch launch : launchers)
    if (const auto text = environment(launch.variable)) {
      launch.tasks = whole_number(*text).value_or(1);
      if (launch.tasks > 1) return launch;
    }
  return {};
}

WorkerShare share_of_batch_system(std::string_view text, const ProcessVariables& environment) {
  const auto number = [&](const char* name) -> std::optional<std::size_t> {
    const auto value = name == nullptr ? std::nullopt : environment(name);
    return value ? whole_number(*value) : std::nullopt;  // SGE writes "undefined" outside of arrays
  };
  std::optional<std::size_t> given;
  if (text.size() > 4) {
    given = whole_number(text.substr(5));
    if (text[4] != '/' || !given || *given == 0) refuse(text, "no number of tasks");
  }
  WorkerShare share;
  bool told = false;
  for (const ArrayVariables& names : systems) {
    const auto task = number(names.task);
    if (!task) continue;
    told = true;
    const auto first = number(names.first), last = number(names.last);
    const std::size_t step = std::max<std::size_t>(1, number(names.step).value_or(1));
    if (given) {
      share = {*task % *given, *given};
    } else if (first && last && *first <= *task && *task <= *last) {
      share = {(*task - *first) / step, (*last - *first) / step + 1};
      const auto count = number("SLURM_ARRAY_TASK_COUNT");
      if (names.task == systems[0].task && count && *count != share.count)
        refuse(text, fmt::format("an array of {} tasks numbered {} to {}, not one after the other",
                                 *count, *first, *last));
    } else {
      refuse(text, fmt::format("{} is set, but not how many tasks there are", names.task));
    }
    break;
  }
  Launch launch = launch_of(environment);
  // A script of sbatch is one task, whatever it asked for; of a job that is not seen srun is taken
  // to have started all of its tasks.
  const std::size_t asked = number("SLURM_NTASKS").value_or(1);
  if (launch.tasks == 1 && asked > 1 && !environment("SLURM_STEP_NUM_TASKS") &&
      !environment("SLURM_JOB_ID"))
    launch = {asked, "srun", "SLURM_NTASKS", "SLURM_PROCID"};
  const auto rank = number(launch.rank);
  if (rank && *rank < launch.tasks) {
    if (!told && given && *given != launch.tasks)
      refuse(text, fmt::format("{} has started {} tasks", launch.by, launch.tasks));
    share = {share.index * launch.tasks + *rank, share.count * launch.tasks};
    told = true;
  }
  if (!told) refuse(text, "no batch system says which part this is");
  return share;
}

}  // namespace drift::mc
