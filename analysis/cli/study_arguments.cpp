#include "analysis/cli/commands.hpp"

namespace drift::cli {

void StudyArguments::add_to(CLI::App& command) {
  command.add_option("config", config, "study file (TOML)")->required();
  command.add_option("--set", sets, "override a value of the study file: key=value, e.g. plan.dwell=\"20 min\"")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command.add_option("--seed", seed, "override monte_carlo.seed");
  command.add_option("--threads", threads, "number of threads; all by default")->check(CLI::Range(1, 4096));
}

Study StudyArguments::read() const {
  Overrides overrides;
  for (const std::string& text : sets) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      throw InputError(ExitCode::usage, fmt::format("--set {}: expected key=value, for example "
                                                    "--set plan.dwell=\"20 min\"", text));
    overrides.emplace_back(text.substr(0, equals), text.substr(equals + 1));
  }
  if (seed) overrides.emplace_back("monte_carlo.seed", *seed);
  return read_study(config, overrides);
}

}  // namespace drift::cli
