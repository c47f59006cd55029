#pragma once

#include "core/estimate/linearizer.hpp"

namespace drift {

/// The node Jacobians of several intervals, worked out together: lanes are filled across them, and
/// the node at which one ends and the next begins is worked out once where the same is commanded.
/// For models whose terms ask for attitude and command alone.
class StretchJacobians {
 public:
  /// Whether a model is such a one.
  static bool can(const DriftModel& model) { return those_apart(model.terms).none(); }

  /// The timeline must outlive it.
  explicit StretchJacobians(const Timeline& timeline) : timeline_(timeline) {}

  /// Of the intervals first to end - 1. path: rotation vector at every node of the timeline [rad].
  /// Allocates nothing once it has seen the longest stretch.
  void evaluate(std::size_t first, std::size_t end, const Vec3* path, const Mounting& mounting,
                Linearizer& linearizer);
  /// At the nodes of an interval of the stretch.
  const NodeJacobian* of(std::size_t i) const { return &all_[offset_[i - first_]]; }

 private:
  const Timeline& timeline_;
  std::size_t first_ = 0;
  std::vector<std::size_t> offset_;  ///< of each interval's first node
  std::vector<NodeJacobian> all_;
};

}  // namespace drift
