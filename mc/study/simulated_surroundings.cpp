#include "mc/study/simulated_surroundings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/check.hpp"
#include "core/sim/surroundings.hpp"

namespace drift::mc {
namespace {

/// "dir/lab.toml:12" (" and --set" where that added to the list), "--set truth.terms", or the file
/// alone where the terms are those of default.
std::string place_of(const Study& study, const std::string& key) {
  const auto terms = std::ranges::find(study.resolved, key, &Resolved::key);
  if (terms == study.resolved.end()) return study.path;
  if (terms->origin == "--set") return "--set " + key;
  const std::size_t line = terms->origin.rfind(':');
  return line == std::string::npos ? study.path : study.path + terms->origin.substr(line);
}

/// What the terms of a section (its key: "truth", "filter.NAME") follow and a simulated recording
/// has not.
void add_missing(const Study& study, const std::string& section, const ModelSpec& model,
                 std::vector<std::string>& messages) {
  Timeline simulated;
  simulated.carried = study.environment.declared();
  for (const std::string& what : missing_covariates(model.model(), simulated))
    messages.push_back(fmt::format("{}: {}: {}", place_of(study, section + ".terms"),
                                   section == "truth" ? "[truth]" : section, what));
}

void throw_if_any(std::vector<std::string> messages) {
  if (!messages.empty()) throw InputError(ExitCode::config, std::move(messages));
}

}  // namespace

void require_simulable_truth(const Study& study) {
  if (!study.has_truth || study.kind != RecordingKind::platform) return;
  std::vector<std::string> messages;
  add_missing(study, "truth", study.truth, messages);
  throw_if_any(std::move(messages));
}

void require_simulable_models(const Study& study) {
  std::vector<std::string> messages;
  add_missing(study, "truth", study.truth, messages);
  for (const FilterSpec& filter : study.filters)
    add_missing(study, "filter." + filter.name, filter, messages);
  throw_if_any(std::move(messages));
}

}  // namespace drift::mc
