#include <fmt/ranges.h>

#include "analysis/cli/command.hpp"
#include "analysis/cli/frozen_study.hpp"
#include "analysis/cli/print.hpp"
#include "analysis/cli/run_options.hpp"
#include "analysis/cli/study/megabytes.hpp"
#include "analysis/cli/study/whole_results.hpp"
#include "analysis/cli/study_program.hpp"
#include "core/base/output_file.hpp"
#include "core/base/results/folder.hpp"
#include "core/base/results/register.hpp"
#include "core/base/seal.hpp"
#include "mc/engine/replay.hpp"
#include "mc/export/export_hdf5.hpp"
#include "mc/export/export_netcdf.hpp"
#include "mc/export/export_text.hpp"
#include "mc/store/same_study.hpp"
#include "mc/store/study_state.hpp"

namespace drift::cli {
namespace {

/// An export replaces an earlier one of the same study that nobody changed, nothing else.
Stranger other_than(const std::string& hash) {
  return [hash](const std::string& path) -> std::string {
    std::string known = mc::study_hash_of_text(path);
    if (known.empty()) known = mc::study_hash_of_hdf5(path);
    if (known == hash) return seal_holds(path) ? "" : seal_broken;
    return known.empty() ? "no export" : "the export of another study";
  };
}

ExitCode verify(const std::string& folder, const std::string& sample, const StudyProgram& program) {
  const double share = parse_fraction("--sample", sample);
  mc::StudyReader reader(folder);
  const auto [study, work] = frozen_study(folder, reader, program);
  if (share > 0.0) mc::require_same_arithmetic(folder, reader.manifest());
  mc::Verification v = mc::verify(work, reader, share, 0);
  for (const std::string& name : changed_results(folder))
    v.damage.push_back(fmt::format(
        "{}/{}: not as driftscope wrote it. Move it away, and the same command makes it anew",
        folder, name));
  for (const std::string& name : unlisted_results({folder, "run"}))
    v.damage.push_back(fmt::format(
        "{}/{}: not in the list of what driftscope wrote (.driftscope), which may be lost or "
        "damaged: "
        "whether it is as it was nobody can say. Move it away, and the same command makes it anew",
        folder, name));
  show("{}: {} blocks with {} runs, {} missing; {} checksums verified, {} runs executed again\n",
       folder, v.blocks, v.runs, v.missing, v.copies, v.recomputed);
  for (const std::string& line : v.notes) show("damage: {}\n", line);
  for (const std::string& line : v.damage) show("lost: {}\n", line);
  for (const std::string& line : v.mismatch) show("mismatch: {}\n", line);
  if (!v.digest.empty() && v.damage.empty()) show("results {}\n", v.digest);
  if (!v.mismatch.empty())
    throw InputError(
        ExitCode::self_check,
        fmt::format("{}: {} results do not come out again (expected equal bits). Look closer with "
                    "`driftscope replay`",
                    folder, v.mismatch.size()));
  if (!v.damage.empty())
    throw InputError(
        ExitCode::store,
        fmt::format("{}: {} damaged or lost (expected none). Do what is said of each, then run the "
                    "study again with the same command: what is lost is computed anew",
                    folder,
                    v.damage.size() == 1 ? std::string("1 part is")
                                         : fmt::format("{} parts are", v.damage.size())));
  if (v.blocks == 0 && v.missing == 0)
    throw InputError(
        ExitCode::store,
        fmt::format(
            "{}: holds no results, and does not say how many were asked for (expected blocks of "
            "runs). Run the study again with the same command",
            folder));
  show("{}\n", v.missing > 0 ? "sound, not complete" : "sound and complete");
  return ExitCode::ok;
}

std::string suffix_of(const std::string& format) {
  return format == "hdf5" ? "h5" : format == "netcdf" ? "nc" : format;
}

ExitCode export_results(const std::string& folder, const std::string& format,
                        const std::string& output, const StudyProgram& program) {
  const std::string target =
      output.empty() ? fmt::format("{}/export.{}", folder, suffix_of(format)) : output;
  mc::StudyReader reader(folder);
  const auto [study, work] = frozen_study(folder, reader, program);
  require_output_file(target, {}, other_than(reader.manifest().hash));
  const mc::StudyState state =
      require_whole(folder, reader, work.stop_rules, "Nothing was exported");
  if (!state.all())
    say("note: the study is not finished: {} of {} runs, {} of {} points complete\n", state.runs,
        state.asked * state.points.size(), state.complete, state.points.size());
  std::vector<std::string> groups;
  const auto points = program.points ? program.points(study) : std::vector<mc::StudyPoint>{};
  if (format == "hdf5") groups = mc::export_hdf5(reader, work.stop_rules, target, points);
  if (format == "netcdf" && points.empty())
    throw InputError(ExitCode::usage,
                     fmt::format("{}: these results have no filters to name arrays by (expected "
                                 "those of `driftscope run`). Export them as hdf5, csv or json",
                                 folder));
  if (format == "netcdf") mc::export_netcdf(reader, work.stop_rules, target, points);
  if (format == "csv") mc::export_csv(reader, work.stop_rules, target, points);
  if (format == "json") mc::export_json(reader, work.stop_rules, target, points);
  require_read_again(folder, reader, target, state.runs);
  show("{}: {} runs, {:.3g} MB\n", target, state.runs, megabytes_of({target}));
  if (!groups.empty()) show("groups: {}\n", fmt::join(groups, " "));
  return ExitCode::ok;
}

}  // namespace

Command verify_command() {
  struct Arguments {
    std::string folder, sample = "1%";
  };
  const auto add = [](CLI::App& app, Arguments& a) {
    add_folder(app, a.folder);
    app.add_option("--sample", a.sample, "share of the runs to execute again, 1% by default")
        ->type_name("SHARE");
  };
  return {"verify", group::studies, "check every checksum and execute some runs again",
          "driftscope verify results/study --sample 5%",
          with_arguments<Arguments>(
              add, [](const Arguments& a) { return verify(a.folder, a.sample, study_program()); })};
}

Command export_command() {
  struct Arguments {
    std::string folder, format, output;
  };
  const auto add = [](CLI::App& app, Arguments& a) {
    add_folder(app, a.folder);
    app.add_option("--format", a.format, "hdf5, netcdf, csv or json")
        ->required()
        ->check(one_of({"hdf5", "netcdf", "csv", "json"}));
    add_output(app, a.output, "file to write; FOLDER/export.h5, .nc, .csv or .json by default");
  };
  return {"export",
          group::studies,
          "convert the results",
          "driftscope export results/study --format hdf5",
          with_arguments<Arguments>(add,
                                    [](const Arguments& a) {
                                      return export_results(a.folder, a.format, a.output,
                                                            study_program());
                                    }),
          Result::in_files};
}

}  // namespace drift::cli
