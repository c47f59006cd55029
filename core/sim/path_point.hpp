#pragma once

#include "core/plan/timeline.hpp"

namespace drift {

/// A path at one instant.
struct PathPoint {
  Vec3 f_p;
  Vec3 gimbal = Vec3::Zero();       ///< where a term with memory sees the gimbals
  Vec3 gimbal_rate = Vec3::Zero();  ///< by the command alone [rad/s]
};

/// gimbals: whether a term looks at them.
PathPoint path_point(const Mat3& R_lp, double heading, const Interval& interval,
                     const Vec3& omega_ic_l, bool gimbals);

/// What a term with memory is told of the way from a to b, dt [s] later. Of a gimbal whose rate
/// changes its sign, where it does: by its angles and rates at both ends, to the fourth order.
PathStep between(const PathPoint& a, const PathPoint& b, double dt, const Vec3& omega_cmd_p);

}  // namespace drift
