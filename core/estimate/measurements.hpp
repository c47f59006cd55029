#pragma once

#include "core/estimate/linearize.hpp"
#include "core/physics/gimbals.hpp"
#include "core/sim/recording.hpp"

namespace drift {

/// What was measured in each interval of a timeline; NaN where not measured. Shape (3, intervals).
struct Measurements {
  Mat3X acc;     ///< mean specific force [g]
  Mat3X gimbal;  ///< outer, middle, inner at the end of the interval [rad]
};

/// The channels acc_* and gimbal_* of a recording; absent or unread channels are all NaN.
Measurements measurements_of(const Recording& recording, const Readout& readout);

/// Difference of two angles, in (-pi, pi] [rad].
inline double angle_difference(double a, double b) { return std::remainder(a - b, 2.0 * std::numbers::pi); }

/// Gimbal angles predicted at a node, and d angles / d psi_i, shape (3, 3).
struct GimbalPrediction {
  Vec3 angles;
  Mat3 H;
};
GimbalPrediction predict_gimbals(const Node& node, double heading, const Vec3& phi);

}  // namespace drift
