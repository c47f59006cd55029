#pragma once

#include "core/sim/path_in_lanes.hpp"

namespace drift {

/// A motion of the platform to linearise about: that of one set of parameters, through given
/// attitudes at the end of each chain, from which it is integrated back. The beginning of a chain
/// is known within the prior alone, its end from all that was measured in it.
class ReferencePath {
 public:
  /// The timeline must outlive the path.
  ReferencePath(const Timeline& timeline, const DriftModel& model);

  /// Where the chain of this interval, its last, ends: rotation vector [rad].
  void end_chain(const Interval& interval, const Vec3& phi) {
    ends_[static_cast<std::size_t>(interval.chain)] = phi;
  }
  /// Integrates back from the ends, with these parameters. Allocates nothing from the second time
  /// on.
  void place(const Theta& theta);
  /// Rotation vector at every node of the timeline [rad].
  const Vec3* nodes() const { return phi_.data(); }
  /// The same at those of an interval.
  const Vec3* nodes(const Interval& interval) const { return &phi_[interval.first_node]; }

 private:
  const Timeline& timeline_;
  DriftModel model_;
  MemoryRecord memory_;
  bool in_lanes_;
  PathInLanes lanes_;
  std::vector<Vec3> ends_;  ///< of each chain
  Trajectory phi_;
};

}  // namespace drift
