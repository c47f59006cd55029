#include <algorithm>

#include "analysis/cli/command.hpp"
#include "analysis/cli/print.hpp"
#include "analysis/cli/read_recordings.hpp"
#include "analysis/cli/still_to_check.hpp"
#include "analysis/report/study/truth_memory.hpp"
#include "core/plan/case_heading.hpp"
#include "core/plan/plan_memory.hpp"
#include "mc/study/own_terms_on_plan.hpp"
#include "mc/study/servo_check.hpp"
#include "mc/study/simulated_surroundings.hpp"
#include "mc/study/study_notes.hpp"

namespace drift::cli {
namespace {

/// The positions in the order in which a recording has to have them, with the headings of the case
/// that the middle gimbal asks for.
void show_positions(const TestPlan& plan, const Site& site) {
  const std::vector<Passage> passages = plan_passages(plan, site);
  std::size_t width = 18;
  for (const Position& p : plan.positions) width = std::max(width, attitude_text(p).size());
  show("\n{:>8}  {:<36}  {:<{}}  {:>8}  {:<5}  {:<7}  {}\n", "position", "name", "axes", width,
       "case", "mode", "entry", "dwell");
  for (std::size_t k = 0; k < plan.positions.size(); ++k) {
    const Position& p = plan.positions[k];
    show("{:>8}  {:<36}  {:<{}}  {:>4.4g} deg  {:<5}  {:<7}  {:g} min\n", k + 1, p.name,
         attitude_text(p), width, passages[k].dwell.heading0 / detail::deg, key_of(p.mode),
         key_of(p.entry), p.dwell / 60.0);
  }
}

ExitCode check(const StudyArguments& arguments) {
  const mc::Study study = arguments.read();
  if (study.kind == RecordingKind::platform) require_memory_for(study.plan);
  mc::require_simulable_truth(study);
  mc::require_none(study, mc::broken_own_terms(study));
  std::size_t key_width = 0, value_width = 0;
  for (const mc::Resolved& r : study.resolved) {
    key_width = std::max(key_width, r.key.size());
    value_width = std::max(value_width, r.value.size());
  }
  value_width = std::min<std::size_t>(value_width, 60);
  for (const mc::Resolved& r : study.resolved)
    show("{:<{}}  {:<{}}  {}\n", r.key, key_width, r.value, value_width, r.origin);
  if (study.kind == RecordingKind::platform) show_positions(study.plan, study.site);
  if (const auto gravity = assumed_gravity(study))
    say("note: site.gravity is not given: {} is assumed. A recording in m/s^2 is divided by it, "
        "and "
        "K1, in ppm, is off by as many ppm as gravity is there\n",
        *gravity);
  say("{}", report::truth_memory_text(study, 0));
  say("{}", mc::servo_notes(study));
  say("{}", mc::swept_sample_text(study));
  say("{}", still_to_check_text(study));
  return ExitCode::ok;
}

}  // namespace

Command check_command() {
  const auto add = [](CLI::App& app, StudyArguments& study) { add_study(app, study); };
  return {
      "check", group::plans,
      "read a study file, print all values, where each came from and the positions, run nothing",
      "driftscope check configs/table1.toml --set plan.dwell=\"20 min\"",
      with_arguments<StudyArguments>(add, check)};
}

}  // namespace drift::cli
