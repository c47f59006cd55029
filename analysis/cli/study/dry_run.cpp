#include "analysis/cli/study/dry_run.hpp"

#include <algorithm>
#include <chrono>
#include <limits>

#include "analysis/cli/frozen_study.hpp"
#include "analysis/cli/print.hpp"
#include "analysis/cli/progress.hpp"
#include "analysis/cli/study/run_words.hpp"
#include "mc/engine/forecast.hpp"
#include "mc/task/campaign.hpp"

namespace drift::cli {
namespace {

/// What runs cost, from some that were tried.
struct Probed {
  std::size_t runs = 0;
  double seconds = 0.0;
};

Probed probe(const AskedRun& asked, const std::vector<mc::BlockKey>& blocks) {
  constexpr std::size_t most_probes = 32;
  constexpr double most_seconds = 5.0;
  const auto started = std::chrono::steady_clock::now();
  Probed tried;
  // As blocks lie in order of points, steps of this length meet as many points as they can.
  const std::size_t step = std::max<std::size_t>(1, blocks.size() / most_probes);
  for (; !blocks.empty() && tried.runs < most_probes && tried.seconds < most_seconds;
       ++tried.runs) {
    const std::size_t i = tried.runs * step;
    const mc::BlockKey& block = blocks[i % blocks.size()];
    std::vector<double> row(asked.manifest.points[block.point].columns.size(),
                            std::numeric_limits<double>::quiet_NaN());
    asked.work.points[block.point].task->worker()->execute(
        block.first + i / blocks.size() % block.count, row);
    tried.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  }
  return tried;
}

/// What lies in the folder, and what of the study that leaves to be done.
std::string work_text(const AskedRun& asked, const mc::EngineOptions& options,
                      const mc::Forecast& would, std::uint64_t runs) {
  const std::string others = would.others > 0
                                 ? fmt::format("; missing besides: {} of the other workers' parts",
                                               blocks_text(would.others))
                                 : "";
  std::string text = fmt::format(
      "stored           {} runs{}{}{}\n", would.stored + would.beyond,
      would.beyond == 0 ? ""
                        : fmt::format(", {} of them beyond the {} per point that are asked for",
                                      would.beyond, options.runs),
      would.cut_short == 0
          ? ""
          : fmt::format("; {} more are in blocks that a shorter study ended within: they would be "
                        "executed again",
                        would.cut_short),
      would.kept == 0 ? "" : fmt::format("; {} more, of unfinished blocks, are kept", would.kept));
  if (would.own.empty()) {
    const std::string empty = empty_part_text(options.share, asked.manifest, options.runs);
    return text + fmt::format("to execute       nothing, {}{}\n",
                              others.empty()   ? "the study is complete"
                              : !empty.empty() ? empty
                                               : "this worker's part is complete",
                              others);
  }
  return text + fmt::format("to execute       {}{} runs, {}{}{}\n",
                            asked.work.stop_rules ? "at most " : "", runs,
                            blocks_text(would.own.size()), part_text(options.share), others);
}

/// The cost of what is to be executed.
std::string cost_text(const AskedRun& asked, const mc::Forecast& would, std::uint64_t runs,
                      std::size_t processes) {
  if (would.own.empty()) return "";
  double bytes = 0.0;
  for (const mc::BlockKey& block : would.own)
    bytes += static_cast<double>(block.count) *
             (1.0 + 8.0 * static_cast<double>(asked.manifest.points[block.point].columns.size()));
  const int threads = mc::usual_threads();
  const Probed tried = probe(asked, would.own);
  const double each = tried.seconds / static_cast<double>(tried.runs);
  return fmt::format(
      "estimated time   {} with {} threads{} ({:.3g} s per run, {} runs tried)\n"
      "disk             {:.3g} MB\n",
      duration_text(static_cast<double>(runs) * each /
                    (static_cast<double>(threads) * static_cast<double>(processes))),
      threads, processes > 1 ? fmt::format(" in each of {} processes", processes) : "", each,
      tried.runs, 1.1 * bytes / 1e6);
}

}  // namespace

ExitCode dry_run(const AskedRun& asked, mc::EngineOptions options, const mc::Ranks& ranks) {
  const auto& [work, manifest, folder, goes_on] = asked;
  const bool begun = mc::require_claimable(folder, manifest);
  if (begun && goes_on) options.runs = runs_to_go_on_to(folder, options.runs, ranks.leader());
  const mc::Forecast would = mc::forecast(work, options, folder, manifest, begun,
                                          ranks.size() > 1 ? ranks.rank() : options.share.index);
  if (!ranks.leader()) return ExitCode::ok;
  for (const std::string& note : would.notes) say("note: {}\n", note);
  if (begun && !study_file_is_whole(folder, manifest))
    say("note: {}/study.toml is not that of the study: it would be written anew, and what is there "
        "kept beside it\n",
        folder);
  say_asked_before(folder, would.asked_before, options.runs);
  std::uint64_t runs = 0;
  for (const mc::BlockKey& block : would.own) runs += block.count;
  runs -= would.kept;
  const std::size_t points = work.points.size();
  show(
      "folder           {}{}\nstudy points     {}\n"
      "runs             {} ({} per point, in {} blocks of {})\n{}numbers per run  {}\n{}"
      "Nothing was written.\n",
      folder,
      begun              ? ""
      : would.stored > 0 ? " (its manifest.json would be made anew)"
                         : " (new)",
      points, options.runs * points, options.runs, mc::all_blocks(manifest, options.runs).size(),
      manifest.identity.block_size, work_text(asked, options, would, runs),
      manifest.points.front().columns.size(), cost_text(asked, would, runs, ranks.size()));
  for (std::size_t p = 0; p < points; ++p)
    if (!work.points[p].label.empty()) show("point {:<4} {}\n", p, work.points[p].label);
  return ExitCode::ok;
}

}  // namespace drift::cli
