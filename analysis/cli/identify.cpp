#include "analysis/identification/identify.hpp"

#include <nlohmann/json.hpp>

#include "analysis/cli/commands.hpp"
#include "analysis/cli/progress.hpp"
#include "analysis/cli/read_recordings.hpp"
#include "analysis/report/identify/folder.hpp"
#include "analysis/report/identify/text.hpp"
#include "analysis/report/strapdown/report.hpp"
#include "analysis/report/strapdown/results.hpp"
#include "core/base/results_folder.hpp"

namespace drift::cli {
namespace {

ExitCode identify_case(const mc::Study& study, const std::vector<std::string>& paths,
                       const std::string& folder) {
  if (paths.size() != 1)
    throw InputError(ExitCode::usage,
                     fmt::format("identify: a strapdown study takes one recording, {} are "
                                 "given. Name one on the command line",
                                 paths.size()));
  strapdown::StrapdownOptions options;
  options.static_min = study.static_min;
  options.gravity = study.site.gravity;
  options.seed = study.monte_carlo.seed;
  options.equations.clear();
  for (const FilterSpec& f : study.filters) options.equations.push_back(f.coupling);
  if (options.equations.empty()) options.equations = {Coupling::eq5, Coupling::eq6};
  const auto recordings = read_recordings(study, paths);
  const strapdown::StrapdownResult result =
      strapdown::identify_strapdown(recordings.front(), options);
  fmt::print("{}", report::to_text(result));
  if (!folder.empty())
    fmt::print("\nWritten to {}: {}\n", folder,
               fmt::join(report::write_results(study, result, folder), " "));
  return ExitCode::ok;
}

}  // namespace

ExitCode identify(const StudyArguments& arguments, const std::vector<std::string>& paths,
                  const std::string& folder, std::uint64_t run) {
  const mc::Study study = arguments.read();
  require_own_folder(folder, "identify");
  if (study.kind == RecordingKind::strapdown) return identify_case(study, paths, folder);
  const auto progress = progress_reporter(arguments.progress, "estimates");
  const identification::Identification id =
      paths.empty() ? identification::identify_simulated(study, run, arguments.threads, progress)
                    : identification::identify_recordings(study, read_recordings(study, paths),
                                                          arguments.threads, progress);
  fmt::print("{}", report::to_text(study, id));
  if (!folder.empty()) {
    const auto files = report::write_results(study, id, folder);
    fmt::print("\nWritten to {}: {}\n", folder, fmt::join(files, " "));
  }
  return ExitCode::ok;
}

}  // namespace drift::cli
