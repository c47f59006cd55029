#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "mc/store/stored_block.hpp"

namespace drift::mc {

/// Hands out runs to threads, a few of one block at a time, and gathers their rows into blocks.
/// Thread-safe.
class BlockBoard {
 public:
  struct InFlight {
    StoredBlock stored;
    std::size_t columns = 0, taken = 0, left = 0;
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

  BlockBoard(Source next_block, std::vector<std::size_t> columns_of_points)
      : next_block_(std::move(next_block)), columns_(std::move(columns_of_points)) {}

  /// Runs of one block to be executed; nothing if there is no more. most: how many, of a point.
  std::vector<Ticket> take(const std::function<std::size_t(std::size_t point)>& most);
  /// Takes back an executed run; the block if that was its last.
  std::optional<StoredBlock> finish(const Ticket& ticket, const RunOutcome& outcome);

 private:
  std::mutex guard_;
  Source next_block_;
  std::vector<std::size_t> columns_;
  std::shared_ptr<InFlight> current_;
};

}  // namespace drift::mc
