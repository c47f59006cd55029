#include "analysis/planning/rank.hpp"

#include "analysis/cli/commands.hpp"
#include "analysis/cli/print.hpp"
#include "analysis/cli/progress.hpp"
#include "analysis/report/rank/report.hpp"
#include "core/base/results_folder.hpp"

namespace drift::cli {

ExitCode rank(const StudyArguments& arguments, const RankArguments& options) {
  const mc::Study study = arguments.read();
  require_results_folder({options.folder, "rank"}, {study.path});
  if (!study.sweep.empty())
    say("note: the values of {} in [sweep] are not ranked, those above it are. Rank them "
        "one by one with --set\n",
        study.sweep.front().key);
  planning::RankOptions what;
  what.improve = options.improve;
  what.criterion = options.criterion;
  what.threads = arguments.threads;
  planning::ImproveProgress progress;
  if (options.improve > 0) progress = progress_reporter(arguments.progress, "positions");
  const planning::PlanRanking ranking = planning::rank_plan(study, what, progress);
  const report::Report said = report::rank_report(study, ranking);
  std::vector<std::string> files;
  if (!options.folder.empty()) files = report::write_report(said, options.folder);
  show("{}", options.json ? said.document.second : report::to_text(said));
  if (!files.empty()) {
    const std::string written =
        fmt::format("\nWritten to {}: {}\n", options.folder, fmt::join(files, " "));
    if (options.json)
      say("{}", written);
    else
      show("{}", written);
  }
  return ExitCode::ok;
}

}  // namespace drift::cli
