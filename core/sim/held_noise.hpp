#pragma once

#include "core/plan/timeline.hpp"

namespace drift {

/// What white noise of the gyros does within a sample. The simulator holds a value n for the whole
/// of the sample, of variance q^2 / T in each platform axis: so the mean specific force and the
/// gimbal angles at the end hang on the same n. Nothing at rest on the Earth, where it is in what
/// is measured.
///
/// The attitude's error is a rotation in the chain's inertial frame, as in the estimators; the
/// platform is taken to stand as planned, which is wrong by a few mrad of the noise.
struct HeldNoise {
  Mat3 to_middle = Mat3::Zero();    ///< d attitude in the middle / d n [s]
  Mat3 from_middle = Mat3::Zero();  ///< d attitude at the end / d n, less that [s]
  Mat3 beside = Mat3::Zero();  ///< d mean output / d n, the attitude in the middle as it is [g s]
};

HeldNoise held_noise(const Interval& interval, const Timeline& timeline);

}  // namespace drift
