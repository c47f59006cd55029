#include <filesystem>

#include "analysis/cli/commands.hpp"
#include "analysis/cli/frozen_study.hpp"
#include "analysis/cli/run_options.hpp"
#include "analysis/cli/run_progress.hpp"
#include "mc/export_hdf5.hpp"
#include "mc/export_text.hpp"
#include "mc/replay.hpp"

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
  return s.ended_utc.empty() ? "at work, or killed" : fmt::format("ended {} with exit code {}", s.ended_utc, s.exit_code);
}

std::string fact(const mc::Session& s, std::string_view key) {
  for (const auto& [k, value] : s.facts)
    if (k == key) return value;
  return "?";
}

}  // namespace

ExitCode status(const std::string& folder, const StudyProgram& program) {
  mc::StudyReader reader(folder);
  const mc::StudyWork work = program.work(frozen_study(folder, reader));
  const auto& points = reader.manifest().points;
  std::uint64_t done = 0, failed = 0;
  double cpu = 0.0;
  std::size_t complete = 0;
  std::string table;
  for (std::size_t p = 0; p < points.size(); ++p) {
    std::uint64_t here = 0, bad = 0;
    bool enough = false;
    // The rule is asked once more by us: the reader does not say why it stopped.
    const auto rule = work.stop_rules ? work.stop_rules(p) : nullptr;
    reader.each_result(work.stop_rules, p, [&](const mc::StoredBlock& b) {
      enough = rule && b.block.first == here && rule->enough(b.block);
      here += b.block.status.size();
      bad += b.failures.size();
      cpu += b.times.total_s;
    });
    enough = enough || here >= reader.runs();
    if (enough) ++complete;
    table += fmt::format("{:>5}  {:>9} / {:<9} {:>7}  {:<9} {}\n", p, here, reader.runs(), bad, enough ? "complete" : "", points[p].label);
    done += here;
    failed += bad;
  }
  const std::uint64_t total = reader.runs() * points.size();
  fmt::print("{}: {} of {} runs, {} failed, {} of {} points complete\n", folder, done, total, failed, complete, points.size());
  fmt::print("point       runs              failed            label\n{}", table);
  if (complete < points.size() && done > 0)
    fmt::print("about {} of CPU time to go\n", duration_text(cpu / static_cast<double>(done) * static_cast<double>(total - done)));
  fmt::print("disk {:.3g} MB in {} worker files\n", megabytes(reader.files()), reader.files().size());
  for (const mc::Session& s : reader.sessions())
    fmt::print("session {} on {}, {}: {}\n", s.started_utc, fact(s, "host"), std::filesystem::path(fact(s, "file")).filename().string(), ending(s));
  for (const std::string& note : reader.notes()) fmt::print("damage: {}\n", note);
  return ExitCode::ok;
}

ExitCode verify(const std::string& folder, const std::string& sample, int threads, const StudyProgram& program) {
  const double share = parse_fraction("--sample", sample);
  mc::StudyReader reader(folder);
  const mc::StudyWork work = program.work(frozen_study(folder, reader));
  const mc::Verification v = mc::verify(work, reader, share, threads);
  fmt::print("{}: {} blocks with {} runs, {} missing; {} checksums verified, {} runs executed again\n", folder, v.blocks, v.runs,
             v.missing, v.copies, v.recomputed);
  for (const std::string& line : v.notes) fmt::print("damage: {}\n", line);
  for (const std::string& line : v.damage) fmt::print("lost: {}\n", line);
  for (const std::string& line : v.mismatch) fmt::print("mismatch: {}\n", line);
  if (!v.digest.empty()) fmt::print("results {}\n", v.digest);
  if (!v.mismatch.empty())
    throw InputError(ExitCode::self_check, fmt::format("{}: {} results do not come out again (expected equal bits). Look closer with "
                                                       "`driftscope replay`", folder, v.mismatch.size()));
  if (!v.damage.empty())
    throw InputError(ExitCode::store, fmt::format("{}: {} of its parts are damaged (expected none). Run the study again with the "
                                                  "same command: what is lost is computed anew", folder, v.damage.size()));
  fmt::print("{}\n", v.missing > 0 ? "sound, not complete" : "sound and complete");
  return ExitCode::ok;
}

ExitCode export_results(const std::string& folder, const std::string& format, const std::string& output,
                        const StudyProgram& program) {
  mc::StudyReader reader(folder);
  const mc::StudyWork work = program.work(frozen_study(folder, reader));
  if (format == "hdf5") mc::export_hdf5(reader, work.stop_rules, output);
  if (format == "csv") mc::export_csv(reader, work.stop_rules, output);
  if (format == "json") mc::export_json(reader, work.stop_rules, output);
  for (const std::string& note : reader.notes()) fmt::print(stderr, "damage: {}\n", note);
  fmt::print("{}: {:.3g} MB\n", output, megabytes({output}));
  return ExitCode::ok;
}

}  // namespace drift::cli
