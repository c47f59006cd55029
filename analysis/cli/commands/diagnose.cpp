
#include <fmt/ranges.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "analysis/cli/answer.hpp"
#include "analysis/cli/argument_checks.hpp"
#include "analysis/cli/command.hpp"
#include "analysis/cli/print.hpp"
#include "analysis/cli/progress.hpp"
#include "analysis/cli/read_recordings.hpp"
#include "analysis/cli/sharing.hpp"
#include "analysis/diagnosis/diagnose_recordings.hpp"
#include "analysis/report/diagnosis/report.hpp"
#include "analysis/report/noise/noise.hpp"
#include "analysis/report/strapdown/case_report.hpp"
#include "analysis/strapdown/case_diagnose.hpp"
#include "core/base/results/folder.hpp"
#include "core/base/results/turn.hpp"

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
            const report::DiagnosisSource& source, const std::vector<Recording>& recordings,
            const std::string& folder, const std::vector<TextFile>& beside = {}) {
  Rest rest{cards_text(study, recordings) + report::to_text(diagnosis), folder, {}};
  if (!folder.empty()) {
    const ResultsTurn turn({folder, "diagnose"});
    rest.files = report::write_results(study, diagnosis, source, folder, beside);
  }
  if (terminal().json == Terminal::Shown::yes)  // its pictures take a while
    rest.document = report::diagnosis_report(study, diagnosis, source).document.second;
  show_answer(report::diagnosis_in_brief(diagnosis), rest);
}

/// `--full` has it among its remarks.
void say_what_was_left_out(const diagnosis::Diagnosis& found) {
  if (terminal().details == Terminal::Shown::yes) return;
  for (const diagnosis::Remark& remark : found.remarks)
    if (const auto* input = std::get_if<diagnosis::remark::Input>(&remark))
      say("note: {}\n", input->text);
}

ExitCode diagnose_case(const StudyArguments& arguments, const mc::Study& study,
                       const std::vector<std::string>& paths, const std::string& folder) {
  if (paths.size() != 1)
    throw InputError(
        ExitCode::usage,
        fmt::format("diagnose: a strapdown study takes one recording, {} are given. Name one "
                    "on the command line",
                    paths.size()));
  const auto recordings = read_recordings(study, paths, arguments.progress);
  flush_output();
  diagnosis::DiagnoseOptions options;
  options.progress = stage_reporter(arguments.progress, "diagnose");
  options.profiles = diagnosis::Profiles::of_the_causes;
  const strapdown::CaseIdentification id = strapdown::identify_case(study, recordings.front());
  const diagnosis::Diagnosis found = strapdown::diagnose_case(study, id, options);
  say_what_was_left_out(found);
  const report::Provenance provenance = report::provenance_of(study.path, paths);
  const TextFile identification{
      "identification.json",
      report::with_provenance(report::to_json(id, study.site.gravity).dump(2), provenance)};
  finish(study, found,
         {paths,
          report::to_text(report::case_report(study, id)),
          provenance,
          {report::noise_section(id.study.noise, study.site.gravity)}},
         recordings, folder, {identification});
  return ExitCode::ok;
}

ExitCode diagnose_platform(const StudyArguments& arguments, const mc::Study& study,
                           const std::vector<std::string>& paths, const std::string& folder,
                           const std::optional<std::vector<std::string>>& advise) {
  const auto recordings = read_recordings(study, paths, arguments.progress);
  flush_output();
  diagnosis::RecordingsOptions options;
  options.diagnose.progress = stage_reporter(arguments.progress, "diagnose");
  options.diagnose.profiles = diagnosis::Profiles::of_the_causes;
  options.diagnose.proposing = diagnosis::Proposing::where_unexplained;
  if (advise) {
    options.advising = diagnosis::Advising::on_request;
    options.asked = *advise;
  }
  const diagnosis::Diagnosis found = diagnosis::diagnose_recordings(study, recordings, options);
  say_what_was_left_out(found);
  finish(study, found, {paths, "", report::provenance_of(study.path, paths), {}}, recordings,
         folder);
  return ExitCode::ok;
}

/// advise: terms to be told apart by further positions; empty: what the verdict suggests; not
/// given: only where the verdict needs it.
ExitCode diagnose(const StudyArguments& arguments, const std::vector<std::string>& paths,
                  const std::string& folder,
                  const std::optional<std::vector<std::string>>& advise) {
  const mc::Study study = arguments.read();
  require_nominal(study);
  if (advise && study.kind == RecordingKind::strapdown)
    throw InputError(ExitCode::usage,
                     "--advise: a strapdown study has no positions to add (expected a platform "
                     "study). Leave it out; "
                     "more turns about more axes are what helps, and the sigmas of `driftscope "
                     "identify` of a trial run say how much");
  if (!folder.empty()) require_one_task("Start it once");
  require_results_folder({folder, "diagnose"}, with(paths, study.path));
  return study.kind == RecordingKind::strapdown
             ? diagnose_case(arguments, study, paths, folder)
             : diagnose_platform(arguments, study, paths, folder, advise);
}

}  // namespace

Command diagnose_command() {
  struct Arguments {
    StudyArguments study;
    std::vector<std::string> recordings;
    std::string output;
    CLI::Option* advise_option = nullptr;
    std::string advise;
  };
  const auto add = [](CLI::App& app, Arguments& a) {
    add_study(app, a.study);
    app.add_option(
           "recordings", a.recordings,
           "recordings of the study's plan (.csv, .txt, .h5, .mat); of a strapdown study one "
           "alone")
        ->required();
    add_output(app, a.output, "folder for diagnosis.json, report, pictures and patched.toml");
    a.advise_option =
        app.add_option("--advise", a.advise,
                       "which further positions would tell these terms apart and from the nominal "
                       "model; without terms: what the verdict suggests")
            ->type_name("[TERM,...]")
            ->expected(0, 1)
            ->check(check_no_file);
    add_progress(app, a.study.progress);
    add_full(app);
    add_json(app);
  };
  const auto run = [](const Arguments& a) {
    std::optional<std::vector<std::string>> advise;
    if (a.advise_option->count() > 0) advise = list_of(a.advise);
    return diagnose(a.study, a.recordings, a.output, advise);
  };
  return {
      "diagnose", group::recordings,
      "locate a mismatch, name the physics left out (of a platform or a strapdown unit), model it, "
      "show the fit improve",
      "driftscope diagnose configs/diagnose_xsens.toml recording.csv -o out/diagnosis",
      with_arguments<Arguments>(add, run)};
}

}  // namespace drift::cli
