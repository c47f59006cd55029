#include <mutex>

#include "analysis/blind/blind_study.hpp"
#include "analysis/blind/diagnosing_solver.hpp"
#include "analysis/blind/rivals/export_trials.hpp"
#include "analysis/blind/seal.hpp"
#include "analysis/cli/answer.hpp"
#include "analysis/cli/command.hpp"
#include "analysis/cli/print.hpp"
#include "analysis/cli/progress.hpp"
#include "analysis/cli/stop_at_once.hpp"
#include "analysis/inference/thresholds.hpp"
#include "analysis/report/blind/report.hpp"
#include "core/base/results_folder.hpp"

namespace drift::cli {
namespace {

/// What is said where the diagnoses are stopped.
std::string stopped_text(const std::string& folder, std::size_t done, std::size_t total) {
  return fmt::format(
      "stopped: {} of {} trials are answered and kept in {}, those at work are lost; the same "
      "command goes on with the rest\n",
      done, total, folder);
}

/// What others have to do with the trials.
struct Others {
  std::string export_to;  ///< folder for whoever wants to answer them; empty: none
  bool rivals = false;    ///< simple methods answer them beside the diagnosis
};

void export_for(const Others& others, const std::string& folder) {
  if (others.export_to.empty()) return;
  const std::size_t trials = blind::export_trials(folder, others.export_to);
  say("{} trials for others in {}, the key apart in {}/sealed\n", trials, others.export_to,
      others.export_to);
}

std::vector<blind::RivalScore> rivals_of(const Others& others, const std::string& folder,
                                         int threads) {
  if (!others.rivals) return {};
  return blind::score_rivals(folder, inference::SearchLimits::alpha, threads);
}

ExitCode blind(const StudyArguments& arguments, const std::string& folder,
               const std::optional<std::string>& trials, const Others& others) {
  StudyArguments all = arguments;
  if (trials) all.sets.push_back("blind.trials=" + *trials);
  const mc::Study study = all.read();
  require_results_folder({folder, "blind"});
  report::BlindResults results;
  results.title = study.title;
  results.key_hash = blind::make_trials(study, folder, arguments.threads,
                                        progress_reporter(arguments.progress, "recordings"));
  say("Key sealed in {}: SHA-256 {}\n", folder, results.key_hash);
  export_for(others, folder);
  StopAtOnce stop("");
  const auto progress = progress_reporter(arguments.progress, "diagnoses");
  std::mutex guard;
  const auto answered = [&](std::size_t done, std::size_t total) {
    if (progress) progress(done, total);
    const std::scoped_lock lock(guard);
    stop.say(stopped_text(folder, done, total));
  };
  answered(0, study.blind.trials);
  results.answers_hash =
      blind::answer_trials(folder, blind::diagnosing_solver(), arguments.threads, answered);
  say("Answers sealed: SHA-256 {}\n", results.answers_hash);
  results.scores = blind::score_folder(folder);
  results.summary = blind::summarise(results.scores);
  results.rivals = rivals_of(others, folder, arguments.threads);
  const report::Report said =
      with_provenance(report::blind_report(results), report::provenance_of(study.path, {}));
  show_answer(said.brief, {report::to_text(said), folder, report::write_report(said, folder)});
  for (const blind::TrialScore& score : results.scores)
    if (score.answer.failed)
      say("Trial {} has no answer: {}\n", score.key.plan.number, score.answer.failure);
  return results.summary.failed > study.monte_carlo.allowed_failures ? ExitCode::failed_runs
                                                                     : ExitCode::ok;
}

}  // namespace

Command blind_command() {
  struct Arguments {
    StudyArguments study;
    std::string output;
    std::optional<std::string> trials;
    Others others;
  };
  const auto add = [](CLI::App& app, Arguments& a) {
    add_study(app, a.study);
    add_output(app, a.output, "folder for trials, key, answers and report; the same one resumes")
        ->required();
    app.add_option("--trials", a.trials, "override blind.trials");
    app.add_option("--export", a.others.export_to,
                   "folder for whoever wants to answer: recordings and nominal studies, key apart")
        ->type_name("DIR");
    app.add_flag("--rivals", a.others.rivals, "score simple methods on the same trials too");
    add_progress(app, a.study.progress);
    add_full(app);
  };
  return {"blind",
          group::studies,
          "make recordings with concealed effects, diagnose each without the key, then score",
          "driftscope blind configs/blind_small.toml -o out/blind",
          with_arguments<Arguments>(
              add, [](const Arguments& a) { return blind(a.study, a.output, a.trials, a.others); }),
          Result::in_files,
          "stopped: nothing is answered yet; the same command goes on with the rest\n"};
}

}  // namespace drift::cli
