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
  fmt::print("\nWritten to {}: {}\n", folder, fmt::join(files, " "));
  return ExitCode::ok;
}

}  // namespace drift::cli
