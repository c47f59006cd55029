#include "mc/study/simulated_surroundings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/check.hpp"
#include "core/sim/surroundings.hpp"
#include "mc/study/own_terms_on_plan.hpp"
#include "mc/study/place_of.hpp"

namespace drift::mc {
namespace {

/// What the terms of a section (its key: "truth", "filter.NAME") follow, and a test without a
/// recording has not.
void add_missing(const Study& study, const std::string& section, const ModelSpec& model,
                 const Environment& known, std::vector<std::string>& messages) {
  Timeline planned;
  planned.carried = known.declared();
  for (const std::string& what : missing_covariates(model.model(), planned))
    messages.push_back(fmt::format("{}: {}: {}", place_of(study, section + ".terms"),
                                   section == "truth" ? "[truth]" : section, what));
}

void add_missing_of_filters(const Study& study, const Environment& known,
                            std::vector<std::string>& messages) {
  for (const FilterSpec& filter : study.filters)
    add_missing(study, "filter." + filter.name, filter, known, messages);
}

void throw_if_any(std::vector<std::string> messages) {
  if (!messages.empty()) throw InputError(ExitCode::config, std::move(messages));
}

}  // namespace

void require_simulable_truth(const Study& study) {
  if (!study.has_truth || study.kind != RecordingKind::platform) return;
  std::vector<std::string> messages;
  add_missing(study, "truth", study.truth, study.environment, messages);
  throw_if_any(std::move(messages));
  require_none(study, broken_own_terms(study, {&study.truth}, study.environment));
}

void require_simulable_models(const Study& study) {
  std::vector<std::string> messages;
  add_missing(study, "truth", study.truth, study.environment, messages);
  add_missing_of_filters(study, study.environment, messages);
  throw_if_any(std::move(messages));
}

void require_planned_filters(const Study& study, const Environment& known) {
  std::vector<std::string> messages;
  add_missing_of_filters(study, known, messages);
  throw_if_any(std::move(messages));
  std::vector<const ModelSpec*> filters;
  for (const FilterSpec& filter : study.filters) filters.push_back(&filter);
  require_none(study, broken_own_terms(study, filters, known));
}

}  // namespace drift::mc
