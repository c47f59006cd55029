#include "analysis/cli/command.hpp"

#include <fmt/ranges.h>

#include <utility>

#include "analysis/cli/argument_checks.hpp"

namespace drift::cli {

void add_study(CLI::App& app, StudyArguments& study) {
  app.add_option("config", study.config, "study file (TOML)")->required();
  app.add_option("--set", study.sets,
                 "override a value of the study file, e.g. plan.dwell=\"20 min\"; KEY+=VALUE adds "
                 "to a list")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  app.add_option("--seed", study.seed, "override monte_carlo.seed")->check(check_seed);
}

void add_progress(CLI::App& app, std::string& style) {
  app.add_option("--progress", style, "auto, plain, json or none")
      ->check(one_of({"auto", "plain", "json", "none"}));
}

void add_full(CLI::App& app) {
  app.add_flag("--full")->description("print all tables behind the answer");
}

CLI::Option* add_json(CLI::App& app) {
  return app.add_flag("--json")->description("print the answer as JSON, what -o writes, instead");
}

CLI::Option* add_output(CLI::App& app, std::string& path, const std::string& what) {
  return app.add_option("-o,--output", path, what)->check(check_path);
}

void add_folder(CLI::App& app, std::string& folder) {
  app.add_option("folder", folder, "results folder of `run`")->required();
}

CLI::Validator one_of(std::vector<std::string_view> names) {
  std::string listed = fmt::format("{{{}}}", fmt::join(names, ","));
  return {[names = std::move(names)](std::string& text) { return check_one_of(text, names); },
          std::move(listed)};
}

std::function<std::string(std::string)> whole(std::uint64_t least, std::uint64_t most) {
  return [=](const std::string& text) { return check_whole(text, least, most); };
}

}  // namespace drift::cli
