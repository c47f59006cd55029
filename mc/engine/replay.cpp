#include "mc/engine/replay.hpp"

#include <omp.h>

#include <cstring>
#include <limits>

#include "core/base/check.hpp"
#include "core/base/rng.hpp"
#include "mc/task/campaign.hpp"
#include "mc/task/guarded_run.hpp"

namespace drift::mc {
namespace {

bool same_bits(std::span<const double> a, std::span<const double> b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

std::vector<double> nan_row(std::size_t columns) {
  return std::vector<double>(columns, std::numeric_limits<double>::quiet_NaN());
}

/// One worker per thread and point, made when first needed.
class Workers {
 public:
  Workers(const StudyWork& work, int threads)
      : work_(work), threads_(static_cast<std::size_t>(threads)) {}
  RunWorker& mine(std::size_t point) {
    auto& [held, worker] = threads_[static_cast<std::size_t>(omp_get_thread_num())];
    if (!worker || held != point) worker = work_.points[held = point].task->worker();
    return *worker;
  }

 private:
  const StudyWork& work_;
  std::vector<std::pair<std::size_t, std::unique_ptr<RunWorker>>> threads_;
};

/// The stop rule of one point after another, fed as StudyReader::each_result feeds it.
class Following {
 public:
  explicit Following(const StopRules& make) : make_(make) {}
  void follow(const BlockKey& key, const std::optional<StoredBlock>& block) {
    if (!make_) return;
    if (!rule_ || key.point != point_) rule_ = make_(point_ = key.point), gap_ = enough_ = false;
    gap_ = gap_ || !block;
    if (!gap_ && !enough_) enough_ = rule_->enough(block->block);
  }
  bool enough(std::size_t point) const { return rule_ && point == point_ && enough_; }

 private:
  const StopRules& make_;
  std::unique_ptr<StopRule> rule_;
  std::size_t point_ = 0;
  bool gap_ = false, enough_ = false;
};

/// Blocks that are missing of a study that was complete, as ranges of runs.
class Gone {
 public:
  Gone(std::uint64_t finished, std::vector<std::string>& lines)
      : finished_(finished), lines_(lines) {}
  void add(const BlockKey& key) {
    if (key.first >= finished_) return;
    if (open_ && (key.point != point_ || key.first != end_)) tell();
    if (!open_) point_ = key.point, begin_ = key.first, open_ = true;
    end_ = key.first + key.count;
  }
  void tell() {
    if (open_)
      lines_.push_back(
          fmt::format("point {}, runs {} to {}: not there, though the study was complete", point_,
                      begin_, end_ - 1));
    open_ = false;
  }

 private:
  std::uint64_t finished_;
  std::vector<std::string>& lines_;
  bool open_ = false;
  std::size_t point_ = 0;
  std::uint64_t begin_ = 0, end_ = 0;
};

}  // namespace

Replay replay(const RunTask& task, StudyReader& reader, std::size_t point, std::uint64_t run,
              TraceSink* trace) {
  const std::size_t columns = task.columns().size();
  const std::uint64_t first = run - run % reader.manifest().identity.block_size;
  Replay r;
  r.row = nan_row(columns);
  r.outcome = guarded_run(*task.worker(), run, r.row, trace);
  const auto block = reader.read(point, first);
  r.damaged = !block && reader.listed(point, first) != nullptr;
  if (!block || run - first >= block->block.status.size()) return r;
  r.stored = true;
  r.stored_status = block->block.status[run - first];
  const auto from =
      block->block.rows.begin() + static_cast<std::ptrdiff_t>((run - first) * columns);
  r.stored_row.assign(from, from + static_cast<std::ptrdiff_t>(columns));
  r.same = r.outcome.status == r.stored_status && same_bits(r.row, r.stored_row);
  return r;
}

Verification verify(const StudyWork& work, StudyReader& reader, double sample, int threads) {
  const int used = threads > 0 ? threads : usual_threads();
  const std::size_t most_lines = 50;
  Verification v;
  Workers workers(work, used);
  const auto recompute = [&](const Block& block) {
    const std::size_t columns = reader.manifest().points[block.point].columns.size();
    std::vector<std::size_t> chosen;
    for (std::size_t r = 0; r < block.status.size(); ++r) {
      Stream stream(0x766572696679, block.first + r, Purpose::test,
                    static_cast<std::uint32_t>(block.point));
      if (stream.uniform() < sample || (sample > 0.0 && block.first + r == 0)) chosen.push_back(r);
    }
    const auto same = run_campaign(
        chosen.size(),
        [&](std::size_t i) -> char {
          std::vector<double> row = nan_row(columns);
          const RunOutcome outcome =
              guarded_run(workers.mine(block.point), block.first + chosen[i], row);
          return outcome.status == block.status[chosen[i]] &&
                 same_bits(row, std::span(block.rows).subspan(chosen[i] * columns, columns));
        },
        used);
    for (std::size_t i = 0; i < chosen.size(); ++i)
      if (!same[i] && v.mismatch.size() < most_lines)
        v.mismatch.push_back(fmt::format("point {}, run {}: the results differ", block.point,
                                         block.first + chosen[i]));
    v.recomputed += chosen.size();
  };
  v.damage = reader.unsound();
  for (std::string& path : v.damage)
    path += ": the structure of the file is damaged. " + std::string(whole_blocks_are_taken_over);
  for (std::string& line : reader.misfits()) v.damage.push_back(std::move(line));
  Gone gone(reader.manifest().finished, v.damage);
  Following rule(work.stop_rules);
  for (const BlockKey& wanted : all_blocks(reader.manifest(), reader.runs())) {
    std::optional<StoredBlock> best;
    std::size_t copies = 0;
    reader.each_copy(
        wanted.point, wanted.first,
        [&](const std::string& path, const std::optional<StoredBlock>& block) {
          ++copies;
          if (!block) return;
          if (best && !agree(best->block, block->block) && v.mismatch.size() < most_lines)
            v.mismatch.push_back(fmt::format("point {}, first run {}: {} differs from another copy",
                                             wanted.point, wanted.first, path));
          if (!best) best = block;
        });
    v.copies += copies;
    rule.follow(wanted, best);
    if (best) {
      ++v.blocks;
      v.runs += best->block.status.size();
      if (sample > 0.0) recompute(best->block);
    } else if (copies > 0) {
      ++v.missing;
      v.damage.push_back(fmt::format("point {}, first run {}: damaged, and no other copy",
                                     wanted.point, wanted.first));
    } else if (!rule.enough(wanted.point)) {
      ++v.missing;
      gone.add(wanted);
    }
  }
  gone.tell();
  v.notes = reader.notes();
  if (v.mismatch.empty()) v.digest = results_digest(reader, work.stop_rules);
  return v;
}

}  // namespace drift::mc
