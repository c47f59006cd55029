#include "analysis/planning/rank.hpp"

#include <filesystem>
#include <memory>

#include "analysis/cli/answer.hpp"
#include "analysis/cli/command.hpp"
#include "analysis/cli/print.hpp"
#include "analysis/cli/progress.hpp"
#include "analysis/cli/sharing.hpp"
#include "analysis/cli/stop_at_once.hpp"
#include "analysis/planning/shared_steps.hpp"
#include "analysis/report/rank/report.hpp"
#include "analysis/report/study/truth_memory.hpp"
#include "core/base/results/folder.hpp"
#include "core/base/results/turn.hpp"
#include "mc/store/study_identity.hpp"
#include "mc/study/study_notes.hpp"

namespace drift::cli {
namespace {

/// What `rank` takes beside a study.
struct RankArguments {
  std::size_t improve = 0;      ///< positions to propose
  std::string criterion = "A";  ///< A, D or a parameter
  std::string folder;           ///< empty: nothing is written
  Sharing sharing;
};

/// Looks whether the work is shared: asked for, or begun so in the folder.
bool is_shared(const RankArguments& options) {
  const bool possible = options.improve > 0 && !options.folder.empty();
  if (options.sharing.is_asked_for() && !possible)
    throw InputError(ExitCode::usage,
                     "--worker, --max-wall: without --improve or -o (expected both: the candidates "
                     "of --improve are what is shared, in the folder of -o). Add them");
  return possible && (options.sharing.is_asked_for() ||
                      std::filesystem::exists(planning::steps_folder(options.folder)));
}

/// The candidates of a study, in the folder of its results.
std::unique_ptr<planning::SharedSteps> shared_steps(const mc::Study& study,
                                                    const RankArguments& options) {
  const std::string folder = planning::steps_folder(options.folder);
  const mc::Manifest manifest = planning::steps_manifest(mc::identity_of(study), study.text,
                                                         options.improve, options.criterion);
  begin_results({options.folder, "rank"});
  mc::claim_folder(folder, manifest);
  return std::make_unique<planning::SharedSteps>(folder, manifest, options.sharing.session());
}

void say_stopped(const std::string& folder) {
  const mc::StudyState state = planning::steps_state(folder);
  say("{}: {} of {} positions to add are chosen, {} candidates are judged and kept, the time is "
      "over. The same command goes on\n",
      folder, state.complete, state.points.size(), state.runs);
}

ExitCode rank(const StudyArguments& arguments, const RankArguments& options) {
  const mc::Study study = arguments.read();
  if (options.improve > 0 || !options.folder.empty())
    options.sharing.require_part(
        options.improve > 0 ? "Start it once, or add -o DIR and --worker auto or a --worker "
                              "i/n of its own to each"
                            : "Start it once");
  require_results_folder({options.folder, "rank"}, {study.path});
  if (!study.sweep.empty())
    say("note: the values of {} in [sweep] are not ranked, those above it are. Rank them "
        "one by one with --set\n",
        study.sweep.front().key);
  say("{}", mc::swept_sample_text(study));
  say("{}", report::truth_memory_text(study, 0));
  planning::RankOptions what;
  what.improve = options.improve;
  what.criterion = options.criterion;
  planning::ImproveProgress progress;
  if (options.improve > 0) progress = progress_reporter(arguments.progress, "positions");
  std::unique_ptr<planning::SharedSteps> shared;
  std::optional<StopAtOnce> stop;
  if (is_shared(options)) {
    planning::criterion_of(study, options.criterion);  // before anything is written
    shared = shared_steps(study, options);
    stop.emplace(fmt::format(
        "stopped: what is judged is kept in {}; the same command goes on with the rest\n",
        options.folder));
    what.improvement = planning::improve_study(
        study, what,
        [&](std::size_t step, std::size_t candidates, const planning::Judge& judge) {
          return shared->judge(step, candidates, judge);
        },
        progress);
    if (!what.improvement) {
      shared->end(ExitCode::wall_time);
      say_stopped(options.folder);
      return ExitCode::wall_time;
    }
  }
  const planning::PlanRanking ranking = planning::rank_plan(study, what, progress);
  const report::Report said = with_provenance(report::rank_report(study, ranking, options.folder),
                                              report::provenance_of(study.path, {}));
  Rest rest{report::to_text(said), options.folder, {}, said.document.second};
  if (!options.folder.empty()) {
    const ResultsTurn turn({options.folder, "rank"});
    rest.files = report::write_ranking(said, options.folder);
  }
  if (shared) shared->end(ExitCode::ok);
  show_answer(said.brief, rest);
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
    add_output(app, a.rank.folder,
               "folder for rank.json, ranking.csv, pictures, report and improved.toml");
    add_json(app);
    add_sharing(app, a.rank.sharing);
    add_progress(app, a.study.progress);
    add_full(app);
  };
  return {"rank", group::plans,
          "how observable each parameter is on a plan, and which positions to add",
          "driftscope rank configs/table1.toml --improve 3 --criterion eta_x -o out/rank",
          with_arguments<Arguments>(add, [](const Arguments& a) { return rank(a.study, a.rank); })};
}

}  // namespace drift::cli
