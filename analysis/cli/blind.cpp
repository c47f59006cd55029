#include <mutex>

#include "analysis/blind/blind_study.hpp"
#include "analysis/blind/diagnosing_solver.hpp"
#include "analysis/blind/seal.hpp"
#include "analysis/cli/answer.hpp"
#include "analysis/cli/command.hpp"
#include "analysis/cli/print.hpp"
#include "analysis/cli/progress.hpp"
#include "analysis/cli/stop_at_once.hpp"
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

ExitCode blind(const StudyArguments& arguments, const std::string& folder,
               const std::optional<std::string>& trials) {
  StudyArguments all = arguments;
  if (trials) all.sets.push_back("blind.trials=" + *trials);
  const mc::Study study = all.read();
  require_results_folder({folder, "blind"});
  report::BlindResults results;
  results.title = study.title;
  results.key_hash = blind::make_trials(study, folder, arguments.threads,
                                        progress_reporter(arguments.progress, "recordings"));
  say("Key sealed in {}: SHA-256 {}\n", folder, results.key_hash);
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
  };
  const auto add = [](CLI::App& app, Arguments& a) {
    add_study(app, a.study);
    add_output(app, a.output, "folder for trials, key, answers and report; the same one resumes")
        ->required();
    app.add_option("--trials", a.trials, "override blind.trials");
    add_progress(app, a.study.progress);
    add_full(app);
  };
  return {"blind",
          group::studies,
          "make recordings with concealed effects, diagnose each without the key, then score",
          "driftscope blind configs/blind_small.toml -o out/blind",
          with_arguments<Arguments>(
              add, [](const Arguments& a) { return blind(a.study, a.output, a.trials); }),
          Result::in_files,
          "stopped: nothing is answered yet; the same command goes on with the rest\n"};
}

}  // namespace drift::cli
