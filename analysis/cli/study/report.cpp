#include <filesystem>

#include "analysis/cli/command.hpp"
#include "analysis/cli/frozen_study.hpp"
#include "analysis/cli/print.hpp"
#include "analysis/cli/study/whole_results.hpp"
#include "analysis/cli/study_program.hpp"
#include "core/base/results/folder.hpp"

namespace drift::cli {
namespace {

ExitCode report(const std::string& folder, const StudyProgram& program) {
  if (!std::filesystem::exists(folder))
    throw InputError(ExitCode::store,
                     fmt::format("{}: there is no such folder (expected one that holds results). "
                                 "Give the folder that was named with -o",
                                 folder));
  const std::string command = results_of(folder);
  if (command.empty())
    throw InputError(
        ExitCode::store,
        fmt::format("{}: holds no results (expected a folder that run, identify, diagnose, rank or "
                    "blind wrote). Give the folder named with -o",
                    folder));
  if (command == "run") {  // made anew, of as many runs as there are
    files_take_results();
    require_results_folder({folder, "run"});
    mc::StudyReader reader(folder);
    const auto [study, work] = frozen_study(folder, reader, program);
    const mc::StudyState state =
        require_whole(folder, reader, work.stop_rules, "The report stays as it was");
    program.present(study, work, reader, folder);
    require_read_again(folder, reader, "The report", state.runs);
    return ExitCode::ok;
  }
  const std::string file = (std::filesystem::path(folder) / "report.html").string();
  if (!std::filesystem::exists(file))
    throw InputError(
        ExitCode::store,
        fmt::format("{}: report.html is gone (expected beside the results of `{}`). The same "
                    "`driftscope {}` command writes it again",
                    folder, command, command));
  show("{}\n", file);
  return ExitCode::ok;
}

}  // namespace

Command report_command() {
  const auto add = [](CLI::App& app, std::string& folder) {
    add_folder(app, folder);
    add_full(app);
  };
  return {"report", group::studies,
          "the HTML report of a results folder; of a study made anew, finished or not",
          "driftscope report results/study",
          with_arguments<std::string>(
              add, [](const std::string& folder) { return report(folder, study_program()); })};
}

}  // namespace drift::cli
