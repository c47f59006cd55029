#pragma once

#include <array>
#include <optional>
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

/// Memory as a Runge-Kutta step meets it: there, and there only. Of a term that tells moments, what
/// gives it the integral of the memory times anything that changes by up to a parabola within the
/// step, however fast the memory changes; of others the memory itself.
struct StepMemory {
  MemoryPoint begin, half, end;
};

/// Carries the memory of a model's terms along the nominal path of a timeline, interval by
/// interval, anew in every recording. It depends on the path and on a few parameters alone, so
/// nobody integrates it: every step is the exact change.
class MemoryPath {
 public:
  MemoryPath(const Timeline& timeline, const DriftModel& model);

  bool active() const { return active_; }
  /// Moves on over interval i (in order; from the first on as often as wanted) with these
  /// parameters.
  void advance(std::size_t i, const double* theta) { advance_along(i, theta, nullptr); }
  /// The same along another path: phi at the nodes of the interval [rad]; null: the nominal one.
  void advance_along(std::size_t i, const double* theta, const Vec3* phi);
  /// Of the interval: number 2 k is the memory at its node k, number 2 k + 1 half way to the next.
  /// Null where the model has none. Of a term that tells moments, nodes but the even ones after the
  /// first and what is half way are what makes the rules of a step (Simpson's) and of two
  /// (propagate_sensitivity) exact for the memory, however fast it changes within them. So are
  /// means over a row by Simpson's rule; Boole's, of rows of many steps, is off by up to a
  /// thirtieth of a change within two of them.
  const MemoryPoint* points() const { return active_ ? points_.data() : nullptr; }
  /// Of the interval: for the step on from each node but the last. Null where the model has none.
  const StepMemory* steps() const { return active_ ? steps_.data() : nullptr; }
  /// The memory itself, numbered as the points.
  const MemoryPoint* itself() const { return exact_.empty() ? points() : exact_.data(); }
  /// As if the parameters had differed by theta_new - theta_old all along, to first order.
  void shift(const double* theta_old, const double* theta_new);

 private:
  const Timeline* timeline_;
  TermMask terms_;
  bool active_ = false;
  Vec3 gimbal_ = Vec3::Zero();  ///< where the path was last
  double t_ = 0.0;
  std::vector<MemoryPoint> points_;
  std::vector<MemoryPoint> exact_;  ///< empty where points_ are
  std::vector<StepMemory> steps_;
  std::vector<Moments<MemoryPoint>> moments_;  ///< over what lies before each point

  void make_steps_exact();
  void make_points_exact();
};

/// The memory of a whole timeline, for whoever jumps about in it.
class MemoryRecord {
 public:
  MemoryRecord() = default;
  /// Of a model that may have none; there is nothing to read before `trace`.
  MemoryRecord(const Timeline& timeline, const DriftModel& model);

  /// Writes it down for these parameters; allocates nothing from the second time on.
  void trace(const double* theta);
  /// The points of an interval, as MemoryPath has them.
  const MemoryPoint* points(const Interval& interval) const {
    return points_.empty() ? nullptr : &points_[2 * interval.first_node];
  }
  /// The steps of an interval, as MemoryPath has them.
  const StepMemory* steps(const Interval& interval) const {
    return steps_.empty() ? nullptr : &steps_[interval.first_node];
  }
  /// At any time of an interval: from the point before it on, as the path goes.
  MemoryPoint at_time(const Timeline& timeline, const Interval& interval, double t) const;

 private:
  const Timeline* timeline_ = nullptr;
  TermMask terms_;
  std::optional<MemoryPath> path_;
  Theta theta_;
  std::vector<MemoryPoint> points_;
  std::vector<MemoryPoint> itself_;  ///< likewise numbered
  std::vector<StepMemory> steps_;    ///< numbered as the nodes
};

}  // namespace drift
