#include "mc/study/own_terms_on_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/base/check.hpp"
#include "core/physics/own/own_terms.hpp"
#include "core/sim/own_term_gaps.hpp"
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
  return broken;
}

std::vector<BrokenTerm> broken_own_terms(const Study& study) {
  std::vector<const ModelSpec*> models;
  if (study.has_truth) models.push_back(&study.truth);
  for (const FilterSpec& filter : study.filters) models.push_back(&filter);
  return broken_own_terms(study, models, study.environment);
}

void require_none(const Study& study, const std::vector<BrokenTerm>& broken) {
  std::vector<std::string> messages;
  for (const BrokenTerm& term : broken)
    messages.push_back(fmt::format("{}: {}", place_of(study, term.key), term.what));
  if (!messages.empty()) throw InputError(ExitCode::config, std::move(messages));
}

}  // namespace drift::mc
