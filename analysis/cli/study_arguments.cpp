#include "analysis/cli/study_arguments.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <limits>

#include "analysis/cli/print.hpp"
#include "mc/study/study_notes.hpp"

namespace drift::cli {
namespace {

/// A seed as a study file has it: whole numbers of TOML end at 2^63-1, as manifests print them they
/// go to 2^64-1.
std::string seed_of_toml(const std::string& seed) {
  std::uint64_t value = 0;
  const char* const end = seed.data() + seed.size();
  const bool decimal = std::from_chars(seed.data(), end, value).ptr == end;
  return decimal && value > std::numeric_limits<std::int64_t>::max()
             ? fmt::format("\"{:#x}\"", value)
             : seed;
}

}  // namespace

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
  if (seed) overrides.emplace_back("monte_carlo.seed", seed_of_toml(*seed));
  return overrides;
}

mc::Study StudyArguments::read() const {
  mc::Study study = mc::read_study(config, overrides());
  say("{}", mc::idle_settings_text(study));
  return study;
}

}  // namespace drift::cli
