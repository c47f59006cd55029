#include "analysis/identification/identify.hpp"

#include <nlohmann/json.hpp>
#include <optional>

#include "analysis/cli/answer.hpp"
#include "analysis/cli/command.hpp"
#include "analysis/cli/print.hpp"
#include "analysis/cli/progress.hpp"
#include "analysis/cli/read_recordings.hpp"
#include "analysis/cli/sharing.hpp"
#include "analysis/report/identify/report.hpp"
#include "analysis/report/strapdown/case_report.hpp"
#include "core/base/results/folder.hpp"
#include "core/base/results/turn.hpp"

namespace drift::cli {
namespace {

ExitCode identify_case(const mc::Study& study, const std::vector<std::string>& paths,
                       const std::string& folder) {
  if (paths.size() != 1)
    throw InputError(ExitCode::usage,
                     fmt::format("identify: a strapdown study takes one recording, {} are "
                                 "given. Name one on the command line",
                                 paths.size()));
  const auto recordings = read_recordings(study, paths);
  const strapdown::CaseIdentification id = strapdown::identify_case(study, recordings.front());
  for (const std::string& remark : id.study.all_remarks()) say("note: {}\n", remark);
  const report::Report said =
      with_provenance(report::case_report(study, id), report::provenance_of(study.path, paths));
  Rest rest{
      cards_text(study, recordings) + report::to_text(said), folder, {}, said.document.second};
  if (!folder.empty()) {
    const ResultsTurn turn({folder, "identify"});
    rest.files = report::write_report(said, folder);
  }
  show_answer(said.brief, rest);
  return ExitCode::ok;
}

ExitCode identify(const StudyArguments& arguments, const std::vector<std::string>& paths,
                  const std::string& folder, std::optional<std::uint64_t> run) {
  if (run && !paths.empty())
    throw InputError(ExitCode::usage,
                     "--run: recordings are given (expected with a study alone, whose recording is "
                     "simulated: it is the number of that). Leave it out, or the recordings");
  const mc::Study study = arguments.read();
  if (!folder.empty()) require_one_task("Start it once");
  require_results_folder({folder, "identify"}, with(paths, study.path));
  if (study.kind == RecordingKind::strapdown) return identify_case(study, paths, folder);
  const auto progress = progress_reporter(arguments.progress, "estimates");
  const auto recordings = read_recordings(study, paths, arguments.progress);
  const identification::Identification id =
      paths.empty() ? identification::identify_simulated(study, run.value_or(0), 0, progress)
                    : identification::identify_recordings(study, recordings, 0, progress);
  for (const std::string& remark : id.remarks) say("note: {}\n", remark);
  const report::Report said = with_provenance(report::identification_report(study, id),
                                              report::provenance_of(study.path, paths));
  Rest rest{
      cards_text(study, recordings) + report::to_text(said), folder, {}, said.document.second};
  if (!folder.empty()) {
    const ResultsTurn turn({folder, "identify"});
    rest.files = report::write_identification(said, id, folder);
  }
  show_answer(said.brief, rest);
  return ExitCode::ok;
}

}  // namespace

Command identify_command() {
  struct Arguments {
    StudyArguments study;
    std::vector<std::string> recordings;
    std::string output;
    std::optional<std::uint64_t> run;
  };
  const auto add = [](CLI::App& app, Arguments& a) {
    add_study(app, a.study);
    app.add_option(
        "recordings", a.recordings,
        "recordings (.csv, .txt, .h5, .mat) of one unit; of a strapdown study one alone; "
        "none: simulated from [truth]");
    add_output(app, a.output, "folder for tables, pictures and report");
    app.add_option("--run", a.run, "run number of the simulated recording")
        ->check(whole(0, last_run));
    add_progress(app, a.study.progress);
    add_full(app);
    add_json(app);
  };
  return {"identify", group::recordings,
          "estimate the parameters of a recording (platform or strapdown), or of a simulated one",
          "driftscope identify configs/table1.toml -o out/table1",
          with_arguments<Arguments>(add, [](const Arguments& a) {
            return identify(a.study, a.recordings, a.output, a.run);
          })};
}

}  // namespace drift::cli
