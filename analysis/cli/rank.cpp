#include "analysis/planning/rank.hpp"

#include "analysis/cli/commands.hpp"
#include "analysis/cli/progress.hpp"
#include "analysis/report/rank/report.hpp"
#include "core/base/results_folder.hpp"

namespace drift::cli {

ExitCode rank(const StudyArguments& arguments, const RankArguments& options) {
  const mc::Study study = arguments.read();
  require_own_folder(options.folder, "rank");
  if (!study.sweep.empty())
    fmt::print(stderr,
               "note: the values of {} in [sweep] are not ranked, those above it are. Rank them "
               "one by one with --set\n",
               study.sweep.front().key);
  planning::RankOptions what;
  what.improve = options.improve;
  what.criterion = options.criterion;
  what.threads = arguments.threads;
  planning::ImproveProgress progress;
  if (options.improve > 0) progress = progress_reporter(arguments.progress, "positions");
  const planning::PlanRanking ranking = planning::rank_plan(study, what, progress);
  std::vector<std::string> files;
  if (!options.folder.empty()) files = report::write_results(study, ranking, options.folder);
  fmt::print("{}",
             options.json ? report::to_json(study, ranking) : report::to_text(study, ranking));
  if (!files.empty())
    fmt::print(options.json ? stderr : stdout, "\nWritten to {}: {}\n", options.folder,
               fmt::join(files, " "));
  return ExitCode::ok;
}

}  // namespace drift::cli
