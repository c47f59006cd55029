#pragma once

#include <atomic>

#include "analysis/blind/session/trial_folder.hpp"

namespace drift::blind {

/// Tells progress, from any thread.
class Counter {
 public:
  Counter(std::size_t done, std::size_t total, const Progress& progress)
      : total_(total), progress_(progress), done_(done) {}
  void step() {
    const std::size_t done = ++done_;
    if (progress_) progress_(done, total_);
  }

 private:
  std::size_t total_;
  const Progress& progress_;
  std::atomic<std::size_t> done_;
};

}  // namespace drift::blind
