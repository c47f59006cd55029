#include "analysis/cli/shell/commands.hpp"

namespace drift::cli {

// Each is declared at the end of its own file.
Command check_command();
Command new_command();
Command simulate_command();
Command rank_command();
Command terms_command();
Command look_command();
Command convert_command();
Command identify_command();
Command diagnose_command();
Command run_command();
Command status_command();
Command verify_command();
Command replay_command();
Command report_command();
Command export_command();
Command blind_command();
Command help_command();
Command schema_command();
Command completion_command();
Command version_command();

std::vector<Command> commands() {
  return {check_command(),    simulate_command(), new_command(),        rank_command(),
          terms_command(),    look_command(),     convert_command(),    identify_command(),
          diagnose_command(), run_command(),      status_command(),     verify_command(),
          replay_command(),   report_command(),   export_command(),     blind_command(),
          help_command(),     schema_command(),   completion_command(), version_command()};
}

}  // namespace drift::cli
