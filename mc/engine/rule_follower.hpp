#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "mc/store/study_reader.hpp"

namespace drift::mc {

/// Follows the results of every point, as all workers store them, until its stop rule has enough.
class RuleFollower {
 public:
  /// `runs`: per point. Without a maker no point ever has enough before that.
  RuleFollower(const StopRules& make, std::uint64_t runs, StudyReader& reader);

  /// Whether there are rules at all.
  bool follows() const { return !points_.empty(); }
  bool enough(std::size_t point) const { return !points_.empty() && points_[point].enough; }
  /// Takes in what was stored since. One thread at a time.
  void advance();

 private:
  struct Point {
    std::unique_ptr<StopRule> rule;
    std::uint64_t next = 0;
    std::atomic<bool> enough = false;
  };
  std::uint64_t runs_;
  StudyReader& reader_;
  std::vector<Point> points_;
};

}  // namespace drift::mc
