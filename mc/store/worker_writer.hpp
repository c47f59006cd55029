#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "mc/store/kept_runs.hpp"
#include "mc/store/store.hpp"

namespace drift::mc {

/// The file of a worker and the statements that change it. What is damaged in it and can be removed
/// is, when it is opened. InputError (store) if it is damaged beyond that, or somebody else's.
class WorkerWriter : public WorkerFile {
 public:
  WorkerWriter(const std::string& path, std::shared_ptr<const Manifest> manifest, Locks locks,
               Database::Use use = Database::Use::write);

  std::size_t removed() const { return removed_; }  ///< damaged blocks

  std::int64_t begin_session(std::uint64_t runs);
  void end_session(std::int64_t session, int exit_code);

  // Each is a transaction:
  void insert(std::span<const StoredBlock> blocks);
  void keep(std::span<const StoredBlock> parts);
  void forget_kept();
  /// Takes over what is whole in the damaged file of a path; how many blocks that is.
  std::size_t salvage(const std::string& damaged, Locks locks);

 private:
  bool is_foreign();
  std::int64_t last_id();
  void mark();
  void describe();
  void remove_damaged();
  void remove_damaged_sessions();
  void insert(const StoredBlock& b);
  void renew_moments(std::int64_t id, const Block& block);
  void renew_failed(std::int64_t id, std::size_t failed);
  void insert_moments(std::int64_t id, const Block& block, std::size_t columns);

  KeptRuns kept_{db_, *manifest_};
  std::size_t removed_ = 0;
};

}  // namespace drift::mc
