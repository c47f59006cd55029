#pragma once

#include <exception>
#include <functional>
#include <mutex>
#include <utility>
#include <vector>

#include "mc/store/stored_block.hpp"

namespace drift::mc {

/// Blocks on their way to the disk, from any thread.
///
/// The thread that finds nobody storing stores its block and those that others finish meanwhile, so
/// that no thread waits for the disk and a slow disk gets fewer, larger transactions.
class BlockQueue {
 public:
  using Commit = std::function<void(const std::vector<StoredBlock>&)>;

  /// commit: called by one thread at a time.
  explicit BlockQueue(Commit commit) : commit_(std::move(commit)) {}

  /// Throws what commit throws.
  void store(StoredBlock block) {
    std::unique_lock lock(guard_);
    queue_.push_back(std::move(block));
    if (storing_) return;
    storing_ = true;
    while (!queue_.empty() && !error_) {
      const std::vector<StoredBlock> batch = std::exchange(queue_, {});
      lock.unlock();
      try {
        commit_(batch);
      } catch (...) {
        lock.lock();
        storing_ = false;
        lock.unlock();
        throw;
      }
      lock.lock();
    }
    storing_ = false;
  }

  /// Nothing more is stored; the first reason given is kept.
  void give_up(std::exception_ptr reason) {
    const std::scoped_lock lock(guard_);
    if (!error_) error_ = std::move(reason);
  }
  const std::exception_ptr& error() const { return error_; }

 private:
  Commit commit_;
  std::mutex guard_;
  std::vector<StoredBlock> queue_;
  bool storing_ = false;
  std::exception_ptr error_;
};

}  // namespace drift::mc
