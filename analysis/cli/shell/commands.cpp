#include "analysis/cli/shell/commands.hpp"

#include <type_traits>

namespace drift::cli {

/// Declares the commands, each at the end of its own file, and lists them in the order of --help. A
/// new one is its file and its name here.
#define DRIFT_COMMANDS(list, ...)              \
  std::type_identity_t<Command()> __VA_ARGS__; \
  static constexpr Command (*list[])() = {__VA_ARGS__}
DRIFT_COMMANDS(every_command, check_command, simulate_command, new_command, rank_command,
               terms_command, look_command, convert_command, identify_command, diagnose_command,
               run_command, status_command, verify_command, replay_command, report_command,
               export_command, blind_command, help_command, schema_command, completion_command,
               version_command);
#undef DRIFT_COMMANDS

std::vector<Command> commands() {
  std::vector<Command> list;
  for (const auto command : every_command) list.push_back(command());
  return list;
}

}  // namespace drift::cli
