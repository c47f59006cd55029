#include "analysis/cli/commands.hpp"

namespace drift::cli {

void add_check(CLI::App& app, Action& chosen) {
  auto arguments = std::make_shared<StudyArguments>();
  CLI::App* command = app.add_subcommand("check", "read a study file, print all values and where each "
                                                  "came from, run nothing");
  arguments->add_to(*command);
  command->footer("Example: driftscope check configs/table1.toml --set plan.dwell=\"20 min\"");
  command->callback([&chosen, arguments] {
    chosen = [arguments] {
      const Study study = arguments->read();
      std::size_t key_width = 0, value_width = 0;
      for (const Resolved& r : study.resolved) {
        key_width = std::max(key_width, r.key.size());
        value_width = std::max(value_width, r.value.size());
      }
      value_width = std::min<std::size_t>(value_width, 60);
      for (const Resolved& r : study.resolved)
        fmt::print("{:<{}}  {:<{}}  {}\n", r.key, key_width, r.value, value_width, r.origin);
      return ExitCode::ok;
    };
  });
}

}  // namespace drift::cli
