#include "analysis/blind/blind_study.hpp"
#include "analysis/blind/diagnosing_solver.hpp"
#include "analysis/blind/seal.hpp"
#include "analysis/cli/commands.hpp"
#include "analysis/cli/progress.hpp"
#include "analysis/report/blind/report.hpp"
#include "core/base/results_folder.hpp"

namespace drift::cli {

ExitCode blind(const StudyArguments& arguments, const std::string& folder,
               const std::optional<std::string>& trials) {
  StudyArguments all = arguments;
  if (trials) all.sets.push_back("blind.trials=" + *trials);
  const mc::Study study = all.read();
  require_own_folder(folder, "blind");
  report::BlindResults results;
  results.title = study.title;
  results.key_hash = blind::make_trials(study, folder, arguments.threads,
                                        progress_reporter(arguments.progress, "recordings"));
  fmt::print("Key sealed in {}: SHA-256 {}\n", folder, results.key_hash);
  std::fflush(stdout);
  results.answers_hash = blind::answer_trials(folder, blind::diagnosing_solver(), arguments.threads,
                                              progress_reporter(arguments.progress, "diagnoses"));
  fmt::print("Answers sealed: SHA-256 {}\n\n", results.answers_hash);
  results.scores = blind::score_folder(folder);
  results.summary = blind::summarise(results.scores);
  const report::Report said = report::blind_report(results);
  fmt::print("{}", report::to_text(said));
  fmt::print("\nWritten to {}: {}\n", folder, fmt::join(report::write_report(said, folder), " "));
  return ExitCode::ok;
}

}  // namespace drift::cli
