#include "analysis/cli/argument_checks.hpp"
#include "analysis/cli/command.hpp"
#include "analysis/cli/print.hpp"
#include "analysis/cli/shell/man_page.hpp"

namespace drift::cli {
namespace {

struct HelpArguments {
  const CLI::App* program = nullptr;
  std::string command;
  bool man = false;
};

std::string help_text(const CLI::App& app, const std::string& name) {
  return app.get_formatter()->make_help(&app, name, CLI::AppFormatMode::Normal);
}

ExitCode help(const HelpArguments& a) {
  if (a.man) {
    show_text(man_page(*a.program));
    return ExitCode::ok;
  }
  const std::string program = a.program->get_name();
  if (a.command.empty()) {
    show_text(help_text(*a.program, program));
    return ExitCode::ok;
  }
  std::vector<std::string> names;
  for (const CLI::App* command : a.program->get_subcommands(nullptr)) {
    names.push_back(command->get_name());
    if (names.back() != a.command) continue;
    show_text(help_text(*command, program + " " + a.command));
    return ExitCode::ok;
  }
  throw InputError(
      ExitCode::usage,
      unknown("command", a.command, std::vector<std::string_view>(names.begin(), names.end())));
}

}  // namespace

Command help_command() {
  const auto add = [](CLI::App& app, HelpArguments& a) {
    a.program = app.get_parent();
    CLI::Option* command = app.add_option("command", a.command, "a command");
    app.add_flag("--man", a.man, "all of it as a manual page")->excludes(command);
  };
  return {"help", group::program, "this list, or the options of a command",
          "driftscope help identify", with_arguments<HelpArguments>(add, help)};
}

}  // namespace drift::cli
