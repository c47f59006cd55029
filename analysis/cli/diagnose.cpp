#include "analysis/diagnosis/diagnose.hpp"

#include <fmt/ranges.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "analysis/cli/commands.hpp"
#include "analysis/cli/progress.hpp"
#include "analysis/cli/read_recordings.hpp"
#include "analysis/diagnosis/advise.hpp"
#include "analysis/diagnosis/name_recordings.hpp"
#include "analysis/diagnosis/prepare.hpp"
#include "analysis/diagnosis/site_doubt.hpp"
#include "analysis/report/diagnosis/folder.hpp"
#include "analysis/report/diagnosis/text.hpp"
#include "analysis/report/strapdown/report.hpp"
#include "analysis/strapdown/diagnose.hpp"
#include "core/base/results_folder.hpp"
#include "mc/task/campaign.hpp"

namespace drift::cli {
namespace {

void require_nominal(const mc::Study& study) {
  if (study.filters.empty())
    throw InputError(
        ExitCode::config,
        fmt::format("{}: no [[filter]]: its first is the nominal model (expected one). Add a "
                    "section [[filter]] with name, coupling and terms",
                    study.path));
}

void finish(const mc::Study& study, const diagnosis::Diagnosis& diagnosis,
            const report::DiagnosisSource& source, const std::string& folder,
            std::vector<std::string> more = {}) {
  fmt::print("{}", report::to_text(diagnosis));
  if (folder.empty()) return;
  auto files = report::write_results(study, diagnosis, source, folder);
  files.insert(files.end(), more.begin(), more.end());
  fmt::print("\nWritten to {}: {}\n", folder, fmt::join(files, " "));
}

ExitCode diagnose_case(const StudyArguments& arguments, const mc::Study& study,
                       const std::vector<std::string>& paths, const std::string& folder) {
  if (paths.size() != 1)
    throw InputError(
        ExitCode::usage,
        fmt::format("diagnose: a strapdown study takes one recording, {} are given. Name one "
                    "on the command line",
                    paths.size()));
  strapdown::StrapdownOptions options;
  options.static_min = study.static_min;
  options.gravity = study.site.gravity;
  options.seed = study.monte_carlo.seed;
  const auto recordings = read_recordings(study, paths);
  std::fflush(stdout);
  const auto report = stage_reporter(arguments.progress, "diagnose");
  if (report) report("dwells, turns and what each step gains", 0.0);
  const strapdown::StrapdownDiagnosis found =
      strapdown::diagnose_strapdown(study, recordings.front(), options);
  if (report) report("done", 1.0);
  std::vector<std::string> more;
  if (!folder.empty())
    more = write_files({{"identification.json", report::to_json(found.result).dump(2) + "\n"}},
                       folder);
  finish(study, found.diagnosis, {paths, report::to_text(found.result)}, folder, more);
  return ExitCode::ok;
}

ExitCode diagnose_platform(const StudyArguments& arguments, const mc::Study& study,
                           const std::vector<std::string>& paths, const std::string& folder,
                           const std::optional<std::vector<std::string>>& advise) {
  diagnosis::Prepared prepared = diagnosis::prepare(study, read_recordings(study, paths));
  std::fflush(stdout);
  diagnosis::DiagnoseOptions options;
  options.progress = stage_reporter(arguments.progress, "diagnose");
  diagnosis::Diagnosis found = diagnosis::diagnose(prepared.study, prepared.recordings, options);
  if (const auto doubt = diagnosis::site_doubt(prepared.study, prepared.recordings, found))
    found.sentence += " " + doubt->sentence;
  const auto began = std::chrono::steady_clock::now();
  try {
    found.advice = diagnosis::advise(prepared.study, prepared.recordings, found,
                                     {.seed = study.monte_carlo.seed, .asked = advise});
  } catch (const InputError& e) {
    if (e.code() == ExitCode::usage) throw;  // what was asked for is wrong
    found.remarks.push_back(fmt::format("No advice could be made: {}",
                                        e.what()));  // never at the cost of the diagnosis
  }
  found.seconds.emplace_back(
      "advice", std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count());
  found.remarks.insert(found.remarks.begin(), prepared.remarks.begin(), prepared.remarks.end());
  diagnosis::name_recordings(prepared.study, prepared.recordings, found);
  finish(study, found, {paths, ""}, folder);
  return ExitCode::ok;
}

}  // namespace

ExitCode diagnose(const StudyArguments& arguments, const std::vector<std::string>& paths,
                  const std::string& folder,
                  const std::optional<std::vector<std::string>>& advise) {
  const mc::Study study = arguments.read();
  require_nominal(study);
  if (advise && study.kind == RecordingKind::strapdown)
    throw InputError(ExitCode::usage,
                     "--advise: a strapdown study has no positions to add (expected a platform "
                     "study). Leave it out; "
                     "more turns about more axes are what helps");
  require_own_folder(folder, "diagnose");
  std::error_code absent;
  if (!folder.empty() &&
      std::filesystem::equivalent(std::filesystem::path(folder) / "study.toml", study.path, absent))
    throw InputError(
        ExitCode::usage,
        fmt::format(
            "-o {}: its study.toml is the study itself and would be replaced (expected another "
            "folder). Name a folder for results",
            folder));
  require_writable_folder(folder);
  const mc::ThreadCount threads(arguments.threads);
  return study.kind == RecordingKind::strapdown
             ? diagnose_case(arguments, study, paths, folder)
             : diagnose_platform(arguments, study, paths, folder, advise);
}

}  // namespace drift::cli
