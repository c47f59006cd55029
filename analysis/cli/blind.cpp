#include "analysis/blind/blind_study.hpp"
#include "analysis/blind/diagnosing_solver.hpp"
#include "analysis/blind/seal.hpp"
#include "analysis/cli/commands.hpp"
#include "analysis/cli/progress.hpp"
#include "analysis/cli/stop_at_once.hpp"
#include "analysis/report/blind/report.hpp"
#include "core/base/results_folder.hpp"

namespace drift::cli {

ExitCode blind(const StudyArguments& arguments, const std::string& folder,
               const std::optional<std::string>& trials) {
  StudyArguments all = arguments;
  if (trials) all.sets.push_back("blind.trials=" + *trials);
  const mc::Study study = all.read();
  require_results_folder({folder, "blind"});
  const StopAtOnce stop(
      "blind: stopped; what is answered is kept, and the same command goes on with the rest\n");
  report::Hashes hashes;
  hashes.key = blind::make_trials(study, folder, arguments.threads,
                                  progress_reporter(arguments.progress, "recordings"));
  fmt::print("Key sealed in {}: SHA-256 {}\n", folder, hashes.key);
  std::fflush(stdout);
  hashes.answers = blind::answer_trials(folder, blind::diagnosing_solver(), arguments.threads,
                                        progress_reporter(arguments.progress, "diagnoses"));
  fmt::print("Answers sealed: SHA-256 {}\n\n", hashes.answers);
  const auto scores = blind::score_folder(folder);
  const auto summary = blind::summarise(scores);
  fmt::print("{}", report::to_text(summary, scores, hashes));
  const auto files = report::write_report(study.title, summary, scores, hashes, folder);
  for (const blind::TrialScore& score : scores)
    if (score.answer.failed)
      fmt::print("Trial {} has no answer: {}\n", score.key.plan.number, score.answer.failure);
  fmt::print("\nWritten to {}: {}\n", folder, fmt::join(files, " "));
  return summary.failed > study.monte_carlo.allowed_failures ? ExitCode::failed_runs : ExitCode::ok;
}

}  // namespace drift::cli
