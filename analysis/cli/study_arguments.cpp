#include "analysis/cli/study_arguments.hpp"

#include <fmt/format.h>

namespace drift::cli {

mc::Overrides StudyArguments::overrides() const {
  mc::Overrides overrides;
  for (const std::string& text : sets) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      throw InputError(ExitCode::usage, fmt::format("--set {}: expected key=value, for example "
                                                    "--set plan.dwell=\"20 min\"",
                                                    text));
    overrides.emplace_back(text.substr(0, equals), text.substr(equals + 1));
  }
  if (seed) overrides.emplace_back("monte_carlo.seed", *seed);
  return overrides;
}

mc::Study StudyArguments::read() const {
  return mc::read_study(config, overrides());
}

}  // namespace drift::cli
