#pragma once

#include <array>
#include <vector>

#include "core/physics/drift_model.hpp"
#include "core/plan/timeline.hpp"

namespace drift {

inline constexpr std::size_t num_memory = static_cast<std::size_t>(TermLibrary::num_memory);

/// The states that the past has left in the terms with memory, and their derivatives, each with
/// respect to the one parameter of its term that it depends on.
struct MemoryPoint {
  std::array<double, num_memory> value{};
  std::array<double, num_memory> derivative{};
};

/// Carries the memory of a model's terms along the nominal path of a timeline, interval by
/// interval. It depends on the path and on a few parameters alone, so nobody integrates it: every
/// step is the exact change.
class MemoryPath {
 public:
  MemoryPath(const Timeline& timeline, const DriftModel& model);

  bool active() const { return active_; }
  /// Back to before the first interval.
  void reset() { started_ = false; }
  /// Moves on over interval i (in order) with these parameters. Then at(2 k) is the memory at node
  /// k of the interval and at(2 k + 1) half way to the next.
  void advance(std::size_t i, const double* theta);
  const MemoryPoint& at(std::size_t point) const { return points_[point]; }
  /// As if the parameters had differed by theta_new - theta_old all along, to first order.
  void shift(const double* theta_old, const double* theta_new);

 private:
  const Timeline* timeline_;
  TermMask terms_;
  bool active_ = false;
  bool started_ = false;
  Vec3 gimbal_ = Vec3::Zero();  ///< where the nominal path was last
  double t_ = 0.0;
  std::vector<MemoryPoint> points_;
};

/// The memory of a whole timeline, for whoever jumps about in it.
class MemoryRecord {
 public:
  MemoryRecord() = default;
  MemoryRecord(const Timeline& timeline, const DriftModel& model, const double* theta);

  bool empty() const { return points_.empty(); }
  const MemoryPoint& at_node(std::size_t node) const { return points_[2 * node]; }
  /// At any time of an interval: from the point before it on.
  MemoryPoint at_time(const Timeline& timeline, const Interval& interval, double t) const;

 private:
  TermMask terms_;
  Theta theta_;
  std::vector<MemoryPoint> points_;
};

}  // namespace drift
