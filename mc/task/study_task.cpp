#include "mc/task/study_task.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/check.hpp"
#include "core/plan/environment.hpp"
#include "mc/study/own_terms_check.hpp"
#include "mc/study/own_terms_on_plan.hpp"
#include "mc/study/simulated_surroundings.hpp"
#include "mc/task/study_worker.hpp"
#include "mc/task/unmodelled.hpp"

namespace drift::mc {
namespace {

void check(const Study& study) {
  require_own_terms(study);
  const auto refuse = [&](const char* what) {
    throw InputError(ExitCode::config, fmt::format("{}: {}", study.path, what));
  };
  if (study.kind != RecordingKind::platform)
    refuse(
        "a strapdown plan cannot be simulated (expected a platform test). Use `driftscope "
        "identify`");
  if (!study.has_truth)
    refuse("no [truth] to simulate from (expected a section [truth]). Add it, with its coupling");
  if (study.filters.empty())
    refuse(
        "no [[filter]]: nothing to estimate with (expected at least one). Add a section [[filter]] "
        "with "
        "name and coupling");
  if (study.truth.coupling == Coupling::compensated && study.truth.loop == LoopEstimate::feedback)
    refuse(
        "a loop fed back from a filter makes other data for every filter, so filters cannot be "
        "compared "
        "on the same data (expected truth.loop.estimate = \"given\"). Use `driftscope identify`");
  std::vector<std::string> messages;
  for (const FilterSpec& filter : study.filters)
    for (const std::string& what : unmodelled(study.monte_carlo.estimator, filter))
      messages.push_back(fmt::format("{}: {}", study.path, what));
  if (!messages.empty()) throw InputError(ExitCode::config, messages);
}

}  // namespace

StudyTask::StudyTask(Study study)
    : study_((check(study), std::move(study))),
      timeline_(lay_out(study_.plan, study_.site)),
      layout_(study_),
      named_(layout_.named()) {
  set_loop(timeline_, study_.truth);
  set_environment(timeline_, study_.environment, study_.monte_carlo.seed, 0);
  resolve_own_terms(timeline_, study_);
  require_simulable_models(study_);
}

std::size_t StudyTask::together() const {
  const bool in_lanes =
      study_.monte_carlo.estimator != EstimatorKind::batch &&
      std::ranges::any_of(study_.filters, [&](const FilterSpec& f) { return goes_in_lanes(f); });
  return in_lanes ? LaneIntervals::width : 1;
}

bool StudyTask::goes_in_lanes(const FilterSpec& filter) const {
  const bool each_its_own =
      study_.environment.fluctuates() && TermLibrary::needs(filter.model().terms).covariates != 0;
  return LaneIntervals::can(filter, timeline_) && !each_its_own;
}

std::unique_ptr<RunWorker> StudyTask::worker() const {
  require_own_terms(study_);
  return std::make_unique<StudyWorker>(*this);
}

std::vector<TaskPoint> study_tasks(const std::vector<StudyPoint>& points) {
  std::vector<TaskPoint> tasks;
  for (const StudyPoint& p : points)
    tasks.push_back({p.label, std::make_unique<StudyTask>(p.study)});
  return tasks;
}

}  // namespace drift::mc
