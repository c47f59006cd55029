#pragma once

#include <atomic>
#include <optional>

namespace drift::mc {

/// Whether another group of runs that are executed together ends before the time of a session is
/// over, judged by the longest so far. Thread-safe.
class TimeForGroups {
 public:
  /// `most`: the session's time [s]; nothing: no limit.
  explicit TimeForGroups(std::optional<double> most) : most_(most) {}

  /// `now`: since the session began [s]. One group is begun however short the time, so that the
  /// same call, again and again, comes to an end.
  bool is_over(double now) const {
    constexpr double margin = 1.1;  // groups are alike, not equal
    return most_ && begun_ && now + margin * longest_ >= *most_;
  }
  void begin() { begun_ = true; }
  void end(double seconds) {
    double longest = longest_;
    while (longest < seconds && !longest_.compare_exchange_weak(longest, seconds)) {
    }
  }
  double longest() const { return longest_; }  ///< [s]

 private:
  std::optional<double> most_;
  std::atomic<bool> begun_ = false;
  std::atomic<double> longest_ = 0.0;
};

}  // namespace drift::mc
