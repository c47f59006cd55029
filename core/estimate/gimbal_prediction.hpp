#pragma once

#include "core/estimate/rows3.hpp"
#include "core/plan/timeline.hpp"

namespace drift {

/// Gimbal angles predicted at a node [rad], and d angles / d psi_i, shape (3, 3). At rest
/// (Interval::rest) what is measured in their place [rad/s].
struct GimbalPrediction {
  Vec3 angles;
  Mat3 H;
  Rows3 H_rate = {};  ///< d angles / d rate states; no columns but at rest
  Rows3 H_par = {};   ///< d angles / d readout states; no columns where no term acts on the gimbals
};

/// phi: rotation vector of the platform against the reference; heading: of the case [rad].
GimbalPrediction predict_gimbals(const Node& node, double heading, const Vec3& phi);

}  // namespace drift
