#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "mc/store/stored_block.hpp"

namespace drift::mc {

/// Hands out runs to threads, a few of one block at a time, and gathers their rows into blocks.
/// Thread-safe.
///
/// The runs of a block go in fixed groups, from its first run on, as many as it pays to execute
/// together: which runs share a group is the same in every session. What an earlier session kept of
/// a block is taken over by whole groups.
class BlockBoard {
 public:
  struct InFlight {
    StoredBlock stored;
    std::size_t columns = 0, group = 1;
    std::size_t next = 0;  ///< the first run to be handed out
    std::size_t left = 0;  ///< runs that have no result yet
    std::size_t taken_over = 0;
    bool has_failed = false;  ///< a run of it, here
    enum class Run : char { to_do, done, taken_over };
    std::vector<Run> runs;
    std::vector<BlockTimes> times;  ///< of the runs done
  };

  /// A run to be executed, and where its row goes (full of NaN).
  struct Ticket {
    std::shared_ptr<InFlight> block;
    std::size_t offset = 0;
    std::size_t point() const { return block->stored.block.point; }
    std::uint64_t run() const { return block->stored.block.first + offset; }
    std::span<double> row() const {
      return std::span(block->stored.block.rows).subspan(offset * block->columns, block->columns);
    }
  };

  /// The next block to begin, or nothing; called under the lock of the board.
  using Source = std::function<std::optional<BlockKey>()>;
  using Most = std::function<std::size_t(std::size_t point)>;

  BlockBoard(Source next_block, std::vector<std::size_t> columns_of_points)
      : next_block_(std::move(next_block)), columns_(std::move(columns_of_points)) {}

  /// What earlier sessions kept of blocks that are not begun yet, in parts of at most `block_size`.
  void go_on_from(std::vector<StoredBlock> parts, std::uint64_t block_size);

  /// Runs of one block to be executed; nothing if there is no more. most: how many, of a point.
  std::vector<Ticket> take(const Most& most);
  enum class Failed { kept, left_out };
  /// Takes back an executed run; the block if that was its last. `left_out`: one with a run that
  /// failed here stays unfinished.
  std::optional<StoredBlock> finish(const Ticket& ticket, const RunOutcome& outcome, Failed failed);

  /// What was taken over from earlier sessions into the blocks begun so far.
  struct TakenOver {
    std::uint64_t runs = 0, failed = 0;
  };
  TakenOver taken_over() const;

  /// The groups executed here, as a part each, of blocks that are not finished; `left_out`: but
  /// those with a failed run. No run may be at work.
  std::vector<StoredBlock> unfinished(Failed failed) const;

 private:
  using Place = std::pair<std::size_t, std::uint64_t>;  ///< point and first run of a block
  bool begin(const Most& most);
  void take_over(InFlight& block);

  mutable std::mutex guard_;
  Source next_block_;
  std::vector<std::size_t> columns_;
  std::map<Place, std::vector<StoredBlock>> kept_;
  std::map<Place, std::shared_ptr<InFlight>> begun_;  ///< not finished
  std::shared_ptr<InFlight> current_;
  TakenOver taken_over_;
};

}  // namespace drift::mc
