#pragma once

#include "core/estimate/linearizer.hpp"

namespace drift {

/// The node Jacobians of several intervals, worked out together: lanes are filled across them, and
/// the node at which one ends and the next begins is worked out once where both look alike.
class StretchJacobians {
 public:
  /// The timeline must outlive it.
  StretchJacobians(const Timeline& timeline, const DriftModel& model)
      : timeline_(timeline),
        mounting_(model.mounting),
        attitude_alone_(all_in_lanes(model.terms)) {}

  /// Of the intervals first to end - 1. path: rotation vector at every node of the timeline [rad];
  /// memory: may be null where no term of the model has any. Allocates nothing once it has seen the
  /// longest stretch.
  void evaluate(std::size_t first, std::size_t end, const Vec3* path, Linearizer& linearizer,
                const MemoryRecord* memory = nullptr);
  /// At the nodes of an interval of the stretch.
  const NodeJacobian* of(std::size_t i) const { return &all_[offset_[i - first_]]; }

 private:
  bool shared(const Interval& a, const Interval& b, const MemoryRecord* memory) const;

  const Timeline& timeline_;
  Mounting mounting_;
  bool attitude_alone_;  ///< the terms ask for no more than that and the command
  std::size_t first_ = 0;
  std::vector<std::size_t> offset_;  ///< of each interval's first node
  std::vector<NodeJacobian> all_;
};

}  // namespace drift
