#include "analysis/identification/identify.hpp"

#include <nlohmann/json.hpp>

#include "analysis/cli/commands.hpp"
#include "analysis/cli/print.hpp"
#include "analysis/cli/progress.hpp"
#include "analysis/cli/read_recordings.hpp"
#include "analysis/report/identify/report.hpp"
#include "analysis/report/strapdown/report.hpp"
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
  const report::Report said = report::strapdown_report(study, result);
  show("{}", report::to_text(said));
  if (!folder.empty())
    show("\nWritten to {}: {}\n", folder, fmt::join(report::write_report(said, folder), " "));
  return ExitCode::ok;
}

}  // namespace

ExitCode identify(const StudyArguments& arguments, const std::vector<std::string>& paths,
                  const std::string& folder, std::uint64_t run) {
  const mc::Study study = arguments.read();
  require_results_folder({folder, "identify"}, with(paths, study.path));
  if (study.kind == RecordingKind::strapdown) return identify_case(study, paths, folder);
  const auto progress = progress_reporter(arguments.progress, "estimates");
  const auto recordings = read_recordings(study, paths);
  const identification::Identification id =
      paths.empty()
          ? identification::identify_simulated(study, run, arguments.threads, progress)
          : identification::identify_recordings(study, recordings, arguments.threads, progress);
  for (const std::string& remark : id.remarks) say("note: {}\n", remark);
  const report::Report said = report::identification_report(study, id);
  show("{}", report::to_text(said));
  if (!folder.empty())
    show("\nWritten to {}: {}\n", folder,
         fmt::join(report::write_identification(said, id, folder), " "));
  return ExitCode::ok;
}

}  // namespace drift::cli
