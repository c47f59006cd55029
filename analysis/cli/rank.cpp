#include "analysis/rank.hpp"

#include "analysis/cli/commands.hpp"
#include "analysis/cli/progress.hpp"
#include "analysis/report/rank_report.hpp"

namespace drift::cli {

ExitCode rank(const StudyArguments& arguments, const RankArguments& options) {
  const Study study = arguments.read();
  RankOptions what;
  what.improve = options.improve;
  what.criterion = options.criterion;
  what.threads = arguments.threads;
  ImproveProgress progress;
  if (options.improve > 0) progress = progress_reporter(arguments.progress, "positions");
  const PlanRanking ranking = rank_plan(study, what, progress);
  std::vector<std::string> files;
  if (!options.folder.empty()) files = write_results(study, ranking, options.folder);
  fmt::print("{}", options.json ? to_json(study, ranking) : to_text(study, ranking));
  if (!files.empty())
    fmt::print(options.json ? stderr : stdout, "\nWritten to {}: {}\n", options.folder, fmt::join(files, " "));
  return ExitCode::ok;
}

}  // namespace drift::cli
