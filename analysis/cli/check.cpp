#include <algorithm>

#include "analysis/cli/commands.hpp"
#include "analysis/cli/print.hpp"
#include "core/plan/plan_memory.hpp"

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

ExitCode check(const StudyArguments& arguments) {
  const mc::Study study = arguments.read();
  if (study.kind == RecordingKind::platform) require_memory_for(study.plan);
  std::size_t key_width = 0, value_width = 0;
  for (const mc::Resolved& r : study.resolved) {
    key_width = std::max(key_width, r.key.size());
    value_width = std::max(value_width, r.value.size());
  }
  value_width = std::min<std::size_t>(value_width, 60);
  for (const mc::Resolved& r : study.resolved)
    show("{:<{}}  {:<{}}  {}\n", r.key, key_width, r.value, value_width, r.origin);
  return ExitCode::ok;
}

}  // namespace drift::cli
