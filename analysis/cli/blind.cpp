#include "analysis/blind/blind_study.hpp"
#include "analysis/blind/diagnosing_solver.hpp"
#include "analysis/blind/seal.hpp"
#include "analysis/cli/command.hpp"
#include "analysis/cli/print.hpp"
#include "analysis/cli/progress.hpp"
#include "analysis/cli/stop_at_once.hpp"
#include "analysis/report/blind/report.hpp"
#include "core/base/results_folder.hpp"

namespace drift::cli {
namespace {

ExitCode blind(const StudyArguments& arguments, const std::string& folder,
               const std::optional<std::string>& trials) {
  StudyArguments all = arguments;
  if (trials) all.sets.push_back("blind.trials=" + *trials);
  const mc::Study study = all.read();
  require_results_folder({folder, "blind"});
  const StopAtOnce stop(
      "blind: stopped; what is answered is kept, and the same command goes on with the rest\n");
  report::BlindResults results;
  results.title = study.title;
  results.key_hash = blind::make_trials(study, folder, arguments.threads,
                                        progress_reporter(arguments.progress, "recordings"));
  show("Key sealed in {}: SHA-256 {}\n", folder, results.key_hash);
  flush_output();
  results.answers_hash = blind::answer_trials(folder, blind::diagnosing_solver(), arguments.threads,
                                              progress_reporter(arguments.progress, "diagnoses"));
  show("Answers sealed: SHA-256 {}\n\n", results.answers_hash);
  results.scores = blind::score_folder(folder);
  results.summary = blind::summarise(results.scores);
  const report::Report said = report::blind_report(results);
  show("{}", report::to_text(said));
  for (const blind::TrialScore& score : results.scores)
    if (score.answer.failed)
      show("Trial {} has no answer: {}\n", score.key.plan.number, score.answer.failure);
  show("\nWritten to {}: {}\n", folder, fmt::join(report::write_report(said, folder), " "));
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
  };
  return {"blind",
          group::studies,
          "make recordings with concealed effects, diagnose each without the key, then score",
          "driftscope blind configs/blind_small.toml -o out/blind",
          with_arguments<Arguments>(
              add, [](const Arguments& a) { return blind(a.study, a.output, a.trials); }),
          Result::in_files};
}

}  // namespace drift::cli
