#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "mc/engine/engine.hpp"

namespace drift::mc {

/// Value of a variable of the environment, nothing where it is not set.
using ProcessVariables = std::function<std::optional<std::string>(const std::string&)>;
std::optional<std::string> process_variable(const std::string& name);

/// Which part of the work a batch system gives this process: an array task of Slurm, SGE or PBS, a
/// task of `srun` or of an mpiexec that this build does not speak, or both. `text` is "auto", or
/// "auto/16" where the system does not say how many there are (PBS) or only some are started again.
/// InputError (usage) where nothing says it.
WorkerShare share_of_batch_system(std::string_view text, const ProcessVariables& environment);

/// How many tasks of this program a launcher has started, by what the launcher tells them.
struct Launch {
  std::size_t tasks = 1;  ///< 1 without one
  const char* by = "";    ///< "srun", "mpirun"
  const char* variable = "";
  const char* rank = "";  ///< variable with the number of the task, from 0
};
Launch launch_of(const ProcessVariables& environment);

}  // namespace drift::mc
