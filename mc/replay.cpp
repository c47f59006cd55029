#include "mc/replay.hpp"

#include <omp.h>

#include <cstring>
#include <limits>
#include <map>

#include "core/base/check.hpp"
#include "core/base/rng.hpp"
#include "mc/campaign.hpp"

namespace drift::mc {
namespace {

RunOutcome execute(RunWorker& worker, std::uint64_t run, std::vector<double>& row, TraceSink* trace) {
  RunOutcome outcome;
  try {
    return trace != nullptr ? worker.trace(run, row, *trace) : worker.execute(run, row);
  } catch (const InputError&) {
    if (trace != nullptr) throw;  // the trace could not be written
    outcome.cause = "input error";
  } catch (const std::exception& error) {
    outcome.cause = error.what();
  }
  outcome.status = RunStatus::error;
  row.assign(row.size(), std::numeric_limits<double>::quiet_NaN());
  return outcome;
}

bool same_bits(std::span<const double> a, std::span<const double> b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

std::vector<double> nan_row(std::size_t columns) {
  return std::vector<double>(columns, std::numeric_limits<double>::quiet_NaN());
}

/// One worker per thread and point, made when first needed.
class Workers {
 public:
  Workers(const StudyWork& work, int threads) : work_(work), threads_(static_cast<std::size_t>(threads)) {}
  RunWorker& mine(std::size_t point) {
    auto& [held, worker] = threads_[static_cast<std::size_t>(omp_get_thread_num())];
    if (!worker || held != point) worker = work_.points[held = point].task->worker();
    return *worker;
  }

 private:
  const StudyWork& work_;
  std::vector<std::pair<std::size_t, std::unique_ptr<RunWorker>>> threads_;
};

}  // namespace

Replay replay(const RunTask& task, StudyReader& reader, std::size_t point, std::uint64_t run, TraceSink* trace) {
  const std::size_t columns = task.columns().size();
  const std::uint64_t first = run - run % reader.manifest().identity.block_size;
  Replay r;
  r.row = nan_row(columns);
  r.outcome = execute(*task.worker(), run, r.row, trace);
  const auto block = reader.read(point, first);
  if (!block || run - first >= block->block.status.size()) return r;
  r.stored = true;
  r.stored_status = block->block.status[run - first];
  const auto from = block->block.rows.begin() + static_cast<std::ptrdiff_t>((run - first) * columns);
  r.stored_row.assign(from, from + static_cast<std::ptrdiff_t>(columns));
  r.same = r.outcome.status == r.stored_status && same_bits(r.row, r.stored_row);
  return r;
}

Verification verify(const StudyWork& work, StudyReader& reader, double sample, int threads) {
  const int used = threads > 0 ? threads : omp_get_max_threads();
  const std::size_t most_lines = 50;
  Verification v;
  Workers workers(work, used);
  const auto recompute = [&](const Block& block) {
    const std::size_t columns = reader.manifest().points[block.point].columns.size();
    std::vector<std::size_t> chosen;
    for (std::size_t r = 0; r < block.status.size(); ++r) {
      Stream stream(0x766572696679, block.first + r, Purpose::test, static_cast<std::uint32_t>(block.point));
      if (stream.uniform() < sample || (sample > 0.0 && block.first + r == 0)) chosen.push_back(r);
    }
    const auto same = run_campaign(chosen.size(), [&](std::size_t i) -> char {
      std::vector<double> row = nan_row(columns);
      const RunOutcome outcome = execute(workers.mine(block.point), block.first + chosen[i], row, nullptr);
      return outcome.status == block.status[chosen[i]] &&
             same_bits(row, std::span(block.rows).subspan(chosen[i] * columns, columns));
    }, used);
    for (std::size_t i = 0; i < chosen.size(); ++i)
      if (!same[i] && v.mismatch.size() < most_lines)
        v.mismatch.push_back(fmt::format("point {}, run {}: the results differ", block.point, block.first + chosen[i]));
    v.recomputed += chosen.size();
  };
  v.damage = reader.unsound();
  for (std::string& path : v.damage) path += ": the structure of the file is damaged";
  for (const BlockKey& wanted : all_blocks(reader.manifest(), reader.runs())) {
    std::optional<StoredBlock> best;
    std::size_t copies = 0;
    reader.each_copy(wanted.point, wanted.first, [&](const std::string& path, const std::optional<StoredBlock>& block) {
      ++copies;
      if (!block) return;
      if (best && !agree(best->block, block->block) && v.mismatch.size() < most_lines)
        v.mismatch.push_back(fmt::format("point {}, first run {}: {} differs from another copy", wanted.point, wanted.first, path));
      if (!best) best = block;
    });
    v.copies += copies;
    if (best) {
      ++v.blocks;
      v.runs += best->block.status.size();
      if (sample > 0.0) recompute(best->block);
    } else if (copies > 0) {
      v.damage.push_back(fmt::format("point {}, first run {}: damaged, and no other copy", wanted.point, wanted.first));
    } else {
      ++v.missing;
    }
  }
  v.notes = reader.notes();
  if (v.mismatch.empty()) v.digest = results_digest(reader, work.stop_rules);
  return v;
}

}  // namespace drift::mc
