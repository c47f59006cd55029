#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "mc/store/manifest.hpp"
#include "mc/store/store_database.hpp"
#include "mc/store/stored_block.hpp"

namespace drift::mc {

/// Runs of blocks that a session began and was stopped in, in tables of a worker file that are
/// there only as long as they hold something:
///   partial           point, first_run, runs, CPU seconds, checksum, payload (block_codec.hpp)
///   partial_failures  point, run, status, cause, t_s, seconds
/// A part holds runs that were executed together. It is no result: only a session that goes on with
/// its block reads it, and one whose block another worker has stored is read by nobody and goes
/// with the next session of its own worker that finds the study complete. Its checksum is none that
/// a block could have.
class KeptRuns {
 public:
  KeptRuns(Database& db, const Manifest& manifest) : db_(db), manifest_(manifest) {}

  using Wanted = std::function<bool(const BlockKey& part)>;
  /// Those that are wanted and fit their checksum; `damaged`: how many do not, or are none.
  std::vector<StoredBlock> read(const Wanted& wanted, std::size_t& damaged);

  // In a transaction of the caller:
  void keep(std::span<const StoredBlock> parts);
  /// What is kept of runs that are stored in a block now.
  void forget(const BlockKey& block);
  void forget_all();
  /// Drops tables that cannot be worked with: nothing in them is a result.
  void mend();

 private:
  bool any();
  std::vector<Failure> failures(const BlockKey& part);
  std::string seal(const BlockKey& part, const std::string& payload,
                   const std::vector<Failure>& failures) const;
  void remove(const BlockKey& runs);

  Database& db_;
  const Manifest& manifest_;
};

}  // namespace drift::mc
