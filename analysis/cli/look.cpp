#include <fmt/ranges.h>

#include <filesystem>

#include "analysis/cli/command.hpp"
#include "analysis/cli/frozen_study.hpp"
#include "analysis/cli/print.hpp"
#include "analysis/cli/run_options.hpp"
#include "analysis/cli/run_progress.hpp"
#include "analysis/cli/study_program.hpp"
#include "core/base/output_file.hpp"
#include "mc/engine/replay.hpp"
#include "mc/export/export_hdf5.hpp"
#include "mc/export/export_netcdf.hpp"
#include "mc/export/export_text.hpp"
#include "mc/store/study_state.hpp"

namespace drift::cli {
namespace {

double megabytes(const std::vector<std::string>& files) {
  double bytes = 0.0;
  for (const std::string& file : files) {
    std::error_code failed;
    const auto size = std::filesystem::file_size(file, failed);
    if (!failed) bytes += static_cast<double>(size);
  }
  return bytes / 1e6;
}

std::string ending(const mc::Session& s) {
  return s.ended_utc.empty() ? "at work, or killed"
                             : fmt::format("ended {} with exit code {}", s.ended_utc, s.exit_code);
}

std::string was_complete(const mc::StudyReader& reader, const mc::StudyState& state) {
  return fmt::format(
      "the study was complete with {} runs per point; of {} of {} points results are not there any "
      "more",
      reader.manifest().finished, state.lost, state.points.size());
}

std::string fact(const mc::Session& s, std::string_view key) {
  for (const auto& [k, value] : s.facts)
    if (k == key) return value;
  return "?";
}

/// An export replaces an earlier one of the same study, nothing else.
Stranger other_than(const std::string& hash) {
  return [hash](const std::string& path) -> std::string {
    std::string known = mc::study_hash_of_text(path);
    if (known.empty()) known = mc::study_hash_of_hdf5(path);
    if (known == hash) return {};
    return known.empty() ? "no export" : "the export of another study";
  };
}

ExitCode status(const std::string& folder, const StudyProgram& program) {
  mc::StudyReader reader(folder);
  const auto [study, work] = frozen_study(folder, reader, program);
  const mc::StudyState state = mc::state_of(reader, work.stop_rules);
  const std::uint64_t total = state.asked * state.points.size();
  show("{}: {} of {} runs, {} failed, {} of {} points complete\n", folder, state.runs, total,
       state.failed, state.complete, state.points.size());
  if (state.by_rule > 0) show("{}\n", state.ended_by_rule());
  show("point       runs              failed            label\n");
  std::uint64_t left = 0;
  double cpu = 0.0;
  for (std::size_t p = 0; p < state.points.size(); ++p) {
    const mc::PointState& s = state.points[p];
    show("{:>5}  {:>9} / {:<9} {:>7}  {:<9} {}\n", p, s.runs, state.asked, s.failed,
         s.complete ? s.by_rule && s.runs < state.asked ? "stop rule" : "complete" : "",
         reader.manifest().points[p].label);
    if (!s.complete) left += state.asked - s.runs;
    cpu += s.cpu_s;
  }
  if (left > 0 && state.runs > 0)
    show("at most {} of CPU time to go\n",
         duration_text(cpu / static_cast<double>(state.runs) * static_cast<double>(left)));
  show("disk {:.3g} MB in {} worker files\n", megabytes(reader.files()), reader.files().size());
  for (const mc::Session& s : reader.sessions())
    show("session {} on {}, {}: {}\n", s.started_utc, fact(s, "host"),
         std::filesystem::path(fact(s, "file")).filename().string(), ending(s));
  for (const std::string& note : reader.notes()) show("damage: {}\n", note);
  if (state.lost > 0) show("lost: {}\n", was_complete(reader, state));
  // What a batch system asks before the last job of a study: 75, as a run that stopped in time.
  return state.complete == state.points.size() ? ExitCode::ok : ExitCode::wall_time;
}

ExitCode verify(const std::string& folder, const std::string& sample, int threads,
                const StudyProgram& program) {
  const double share = parse_fraction("--sample", sample);
  mc::StudyReader reader(folder);
  const auto [study, work] = frozen_study(folder, reader, program);
  const mc::Verification v = mc::verify(work, reader, share, threads);
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
        fmt::format("{}: {} damaged or lost (expected none). Run the study again with the same "
                    "command: what is lost is computed anew",
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
  const mc::StudyState state = mc::state_of(reader, work.stop_rules);
  for (const std::string& note : reader.notes()) complain("damage: {}\n", note);
  if (state.lost > 0 || (!state.all() && !reader.notes().empty()))
    throw InputError(
        ExitCode::store,
        fmt::format(
            "{}: {} (expected whole results). Run the study again with the same command: what "
            "is lost is computed anew. Nothing was exported",
            folder,
            state.lost > 0 ? was_complete(reader, state) : "parts of the results are damaged"));
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
  if (format == "csv") mc::export_csv(reader, work.stop_rules, target);
  if (format == "json") mc::export_json(reader, work.stop_rules, target);
  show("{}: {} runs, {:.3g} MB\n", target, state.runs, megabytes({target}));
  if (!groups.empty()) show("groups: {}\n", fmt::join(groups, " "));
  return ExitCode::ok;
}

}  // namespace

Command status_command() {
  return {"status", group::studies, "how far a study is: runs, failures, sessions, disk",
          "driftscope status results/study",
          with_arguments<std::string>(add_folder, [](const std::string& folder) {
            return status(folder, study_program());
          })};
}

Command verify_command() {
  struct Arguments {
    std::string folder, sample = "1%";
    int threads = 0;
  };
  const auto add = [](CLI::App& app, Arguments& a) {
    add_folder(app, a.folder);
    app.add_option("--sample", a.sample, "share of the runs to execute again, 1% by default")
        ->type_name("SHARE");
    add_threads(app, a.threads);
  };
  return {"verify", group::studies, "check every checksum and execute some runs again",
          "driftscope verify results/study --sample 5%",
          with_arguments<Arguments>(add, [](const Arguments& a) {
            return verify(a.folder, a.sample, a.threads, study_program());
          })};
}

Command export_command() {
  struct Arguments {
    std::string folder, format, output;
  };
  const auto add = [](CLI::App& app, Arguments& a) {
    add_folder(app, a.folder);
    app.add_option("--format", a.format, "hdf5, netcdf, csv or json")
        ->required()
        ->check(CLI::IsMember({"hdf5", "netcdf", "csv", "json"}));
    add_output(app, a.output, "file to write; FOLDER/export.h5, .nc, .csv or .json by default");
  };
  return {"export", group::studies, "convert the results",
          "driftscope export results/study --format hdf5",
          with_arguments<Arguments>(add, [](const Arguments& a) {
            return export_results(a.folder, a.format, a.output, study_program());
          })};
}

}  // namespace drift::cli
