#include <algorithm>

#include "analysis/cli/command.hpp"
#include "analysis/cli/print.hpp"
#include "core/plan/plan_memory.hpp"

namespace drift::cli {
namespace {

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

}  // namespace

Command check_command() {
  const auto add = [](CLI::App& app, StudyArguments& study) { add_study(app, study); };
  return {"check", group::plans,
          "read a study file, print all values and where each came from, run nothing",
          "driftscope check configs/table1.toml --set plan.dwell=\"20 min\"",
          with_arguments<StudyArguments>(add, check)};
}

}  // namespace drift::cli
