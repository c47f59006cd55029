#include "mc/study/own_terms_on_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/base/check.hpp"
#include "core/physics/own/own_terms.hpp"
#include "core/sim/own_term_gaps.hpp"
#include "core/sim/own_term_steps.hpp"
#include "mc/study/place_of.hpp"

namespace drift::mc {
namespace {

bool has_own_terms(const ModelSpec* model) {
  return (model->model().terms >> TermLibrary::num_known).any();
}

BrokenTerm told(const OwnTermGap& gap) {
  return {fmt::format("term.{}.equation", gap.own),
          fmt::format("term '{}' is no finite number at t = {:.6g} s, {} position {} (expected one "
                      "wherever the plan leads). Keep divisors, logarithms and roots away from "
                      "zero, as with max(x, 0.01)",
                      own_terms().terms[gap.own].key, gap.t, gap.slew ? "on the way to" : "in",
                      gap.position + 1)};
}

BrokenTerm told(const UnresolvedOwnTerm& term) {
  return {
      fmt::format("term.{}.equation", term.own),
      fmt::format("term '{}' changes too fast for rows of {:.6g} s: its means over them would be "
                  "off by {:.0f} % (expected at most 5 %). Take shorter rows (plan.sample; "
                  "of a recording as it was read), or leave out what averages out within one",
                  own_terms().terms[term.own].key, term.longest_row, 100.0 * term.off)};
}

std::vector<const ModelSpec*> models_of(const Study& study) {
  std::vector<const ModelSpec*> models;
  if (study.has_truth) models.push_back(&study.truth);
  for (const FilterSpec& filter : study.filters) models.push_back(&filter);
  return models;
}

/// Those that are no number somewhere are told elsewhere, and by the runs that fail.
std::vector<BrokenTerm> too_fast_own_terms(const std::vector<const ModelSpec*>& models,
                                           const Timeline& timeline) {
  std::vector<BrokenTerm> broken;
  std::set<std::size_t> seen;
  for (const ModelSpec* model : models) {
    const std::vector<UnresolvedOwnTerm> too_fast = unresolved_own_terms(timeline, *model);
    if (too_fast.empty()) continue;
    for (const OwnTermGap& gap : own_term_gaps(timeline, *model)) seen.insert(gap.own);
    for (const UnresolvedOwnTerm& term : too_fast)
      if (seen.insert(term.own).second) broken.push_back(told(term));
  }
  return broken;
}

void resolve(Timeline& timeline, const Study& study, const std::vector<const ModelSpec*>& models) {
  for (const ModelSpec* model : models) drift::resolve_own_terms(timeline, *model);
  require_none(study, too_fast_own_terms(models, timeline));
}

}  // namespace

std::vector<BrokenTerm> broken_own_terms(const Study& study,
                                         const std::vector<const ModelSpec*>& models,
                                         const Environment& known) {
  std::vector<BrokenTerm> broken;
  if (study.kind != RecordingKind::platform || std::ranges::none_of(models, has_own_terms))
    return broken;
  Timeline timeline = lay_out(study.plan, study.site);
  set_environment(timeline, known, study.monte_carlo.seed, 0);
  std::set<std::size_t> seen;
  for (const ModelSpec* model : models)
    for (const OwnTermGap& gap : own_term_gaps(timeline, *model))
      if (seen.insert(gap.own).second) broken.push_back(told(gap));
  if (!broken.empty()) return broken;
  for (const ModelSpec* model : models) drift::resolve_own_terms(timeline, *model);
  return too_fast_own_terms(models, timeline);
}

std::vector<BrokenTerm> broken_own_terms(const Study& study) {
  return broken_own_terms(study, models_of(study), study.environment);
}

void require_none(const Study& study, const std::vector<BrokenTerm>& broken) {
  std::vector<std::string> messages;
  for (const BrokenTerm& term : broken)
    messages.push_back(fmt::format("{}: {}", place_of(study, term.key), term.what));
  if (!messages.empty()) throw InputError(ExitCode::config, std::move(messages));
}

void resolve_own_terms(Timeline& timeline, const Study& study) {
  resolve(timeline, study, models_of(study));
}

void resolve_own_terms_of_filters(Timeline& timeline, const Study& study) {
  std::vector<const ModelSpec*> filters;
  for (const FilterSpec& filter : study.filters) filters.push_back(&filter);
  resolve(timeline, study, filters);
}

}  // namespace drift::mc
