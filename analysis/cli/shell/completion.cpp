#include "analysis/cli/shell/completion.hpp"

#include <sstream>

#include "analysis/cli/command.hpp"
#include "analysis/cli/print.hpp"
#include "analysis/cli/shell/schema.hpp"
#include "core/physics/parameters_config.hpp"

namespace drift::cli {
namespace {

/// "TEXT:{auto,plain}" -> auto, plain.
std::vector<std::string> members_of(const std::string& type) {
  const auto open = type.find('{'), close = type.find('}');
  std::vector<std::string> members;
  if (open == std::string::npos || close == std::string::npos) return members;
  std::istringstream list(type.substr(open + 1, close - open - 1));
  for (std::string member; std::getline(list, member, ',');) members.push_back(member);
  return members;
}

std::vector<CompletedOption> options_of(const CLI::App& app,
                                        const std::vector<std::string>& set_keys) {
  std::vector<CompletedOption> options;
  for (const CLI::Option* o : app.get_options(nullptr)) {
    if (o->get_positional()) continue;
    CompletedOption option;
    for (const std::string& name : o->get_snames()) option.names.push_back("-" + name);
    for (const std::string& name : o->get_lnames()) option.names.push_back("--" + name);
    option.what = o->get_description();
    option.takes_value = o->get_expected_max() > 0;
    option.values = members_of(o->get_type_name());
    if (o->check_lname("set")) option.values = set_keys;
    options.push_back(std::move(option));
  }
  return options;
}

std::vector<std::string> arguments_of(const std::string& command,
                                      const std::vector<std::string>& commands) {
  std::vector<std::string> values;
  if (command == "help") return commands;
  if (command == "completion") return {"bash", "zsh", "fish"};
  if (command == "terms") {
    for (const auto key : term_keys()) values.emplace_back(key);
    for (const auto key : parameter_keys()) values.emplace_back(key);
  }
  return values;
}

struct CompletionArguments {
  const CLI::App* program = nullptr;
  std::string shell;
};

ExitCode completion(const CompletionArguments& a) {
  const auto commands = completed_commands(*a.program);
  if (a.shell == "bash") show_text(bash_completion(commands));
  if (a.shell == "zsh") show_text(zsh_completion(commands));
  if (a.shell == "fish") show_text(fish_completion(commands));
  return ExitCode::ok;
}

}  // namespace

std::vector<CompletedCommand> completed_commands(const CLI::App& program) {
  std::vector<std::string> set_keys;
  for (const std::string& key : settable_keys()) set_keys.push_back(key + "=");
  std::vector<std::string> names;
  for (const CLI::App* app : program.get_subcommands(nullptr)) names.push_back(app->get_name());
  std::vector<CompletedCommand> all{{"", "", options_of(program, set_keys), names}};
  for (const CLI::App* app : program.get_subcommands(nullptr))
    all.push_back({app->get_name(), app->get_description(), options_of(*app, set_keys),
                   arguments_of(app->get_name(), names)});
  return all;
}

Command completion_command() {
  const auto add = [](CLI::App& app, CompletionArguments& a) {
    a.program = app.get_parent();
    app.add_option("shell", a.shell, "bash, zsh or fish")
        ->required()
        ->check(one_of({"bash", "zsh", "fish"}));
  };
  return {"completion", group::program, "a script that lets the shell complete commands and keys",
          "source <(driftscope completion bash)",
          with_arguments<CompletionArguments>(add, completion)};
}

}  // namespace drift::cli
