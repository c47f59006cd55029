#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

#include "mc/engine/engine.hpp"
#include "mc/engine/inventory.hpp"

namespace drift::mc {

/// What one session has to do of a study, and what it finds done.
class WorkPlan {
 public:
  WorkPlan(const StudyWork& work, const EngineOptions& options, Ranks& ranks, StudyReader& reader,
           RuleFollower& rules);

  /// Plans what no worker file lists, of this worker's share; for several ranks what the leader
  /// found to be missing. What is listed and damaged is met when nothing is missing any more:
  /// reading all that others have stored, at every start, would cost a large study more than its
  /// runs. All ranks come here, and to mend().
  void make();
  /// With nothing missing the results are read; true if damaged blocks of this worker's share were
  /// among them, which are planned then.
  bool mend();

  /// The next block to begin, or nothing. Called by one thread at a time.
  std::optional<BlockKey> next();

  /// What earlier sessions kept of this worker's share of blocks, which are not stored yet.
  std::vector<StoredBlock> kept();

  std::uint64_t runs_before() const { return before_; }
  std::uint64_t failed_before() const { return failed_before_; }
  std::uint64_t cut_short() const { return cut_short_; }
  /// Runs of this session and before, when `done` of them are done.
  std::uint64_t total(std::uint64_t done) const;

  /// What is missing of the study after this session.
  struct Rest {
    std::size_t all = 0, own = 0;      ///< blocks
    std::optional<Verified> verified;  ///< the results, if nothing is missing by the tables
  };
  Rest rest();

 private:
  Listed listed();
  Verified verified();
  std::vector<std::uint64_t> own(const std::vector<std::uint64_t>& blocks) const;

  const StudyWork& work_;
  const EngineOptions& options_;
  Ranks& ranks_;
  StudyReader& reader_;
  RuleFollower& rules_;
  std::vector<BlockKey> all_;
  std::vector<std::uint64_t> todo_;  ///< into all_
  std::uint64_t before_ = 0, failed_before_ = 0;
  std::uint64_t cut_short_ = 0;             ///< runs in blocks too short
  std::uint64_t taken_before_ = 0;          ///< by the ranks' counter, more than there are in todo_
  std::atomic<std::uint64_t> skipped_ = 0;  ///< runs in todo_ whose point had enough meanwhile
  std::optional<Verified> verified_;        ///< and nothing was stored by this session since
};

}  // namespace drift::mc
