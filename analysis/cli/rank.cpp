#include "analysis/planning/rank.hpp"

#include "analysis/cli/answer.hpp"
#include "analysis/cli/command.hpp"
#include "analysis/cli/print.hpp"
#include "analysis/cli/progress.hpp"
#include "analysis/report/rank/report.hpp"
#include "core/base/results_folder.hpp"

namespace drift::cli {
namespace {

/// What `rank` takes beside a study.
struct RankArguments {
  std::size_t improve = 0;      ///< positions to propose
  std::string criterion = "A";  ///< A, D or a parameter
  std::string folder;           ///< empty: nothing is written
  bool json = false;            ///< rank.json on stdout instead of tables
};

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
  const report::Report said =
      with_provenance(report::rank_report(study, ranking), report::provenance_of(study.path, {}));
  Rest rest{options.json ? "" : report::to_text(said), options.folder, {}};
  if (!options.folder.empty()) rest.files = report::write_report(said, options.folder);
  if (!options.json) {
    show_answer(said.brief, rest);
    return ExitCode::ok;
  }
  show("{}", said.document.second);
  if (!rest.files.empty()) say("\nWritten to {}: {}\n", options.folder, fmt::join(rest.files, " "));
  return ExitCode::ok;
}

}  // namespace

Command rank_command() {
  struct Arguments {
    StudyArguments study;
    RankArguments rank;
  };
  const auto add = [](CLI::App& app, Arguments& a) {
    add_study(app, a.study);
    CLI::Option* improve =
        app.add_option("--improve", a.rank.improve, "propose so many further positions")
            ->check(CLI::Range(1, 1000));
    app.add_option("--criterion", a.rank.criterion,
                   "what they make small: A (trace), D (determinant) or a parameter such as eta_x")
        ->needs(improve);
    add_output(app, a.rank.folder, "folder for rank.json, pictures and report");
    app.add_flag("--json", a.rank.json, "rank.json on stdout instead of tables");
    add_progress(app, a.study.progress);
    add_full(app);
  };
  return {"rank", group::plans,
          "how observable each parameter is on a plan, and which positions to add",
          "driftscope rank configs/table1.toml --improve 3 --criterion eta_x -o out/rank",
          with_arguments<Arguments>(add, [](const Arguments& a) { return rank(a.study, a.rank); })};
}

}  // namespace drift::cli
