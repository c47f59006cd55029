#pragma once

#include "core/plan/timeline.hpp"

namespace drift {

/// What white noise of the gyros, of density q^2 in each platform axis, does within a sample of
/// length T to what is measured there: the mean specific force and, at its end, the gimbal angles.
/// With W how far it has turned the platform,
///
///   var(mean W) = q^2 T / 3,   cov(mean W, W_end) = q^2 T / 2,   var(W_end) = q^2 T.
///
/// So the mean hangs on a value n of variance q^2 / T that is new in each sample, by T / sqrt(3),
/// and the end on n by sqrt(3) T / 2 and on another such value, which nothing before it feels, by
/// T / 2. What is felt in the mean is felt at the attitude in the middle. Nothing at rest on the
/// Earth, where it is in what is measured.
///
/// The attitude's error is a rotation in the chain's inertial frame, as in the estimators; the
/// platform is taken to stand as planned, which is wrong by a few mrad of the noise, and to turn
/// steadily with the noise: where it slews through a large angle within a sample, that is an
/// approximation of the law above.
struct HeldNoise {
  Mat3 to_middle = Mat3::Zero();    ///< d attitude in the middle / d n [s]
  Mat3 from_middle = Mat3::Zero();  ///< d attitude at the end / d n, less that [s]
  Mat3 beside = Mat3::Zero();  ///< d mean output / d n, the attitude in the middle as it is [g s]
  Mat3 anew = Mat3::Zero();    ///< d attitude at the end / d the other value [s]
};

HeldNoise held_noise(const Interval& interval, const Timeline& timeline);

/// The simulator holds a value m through a sample, sqrt(3) / 2 n + 1 / 2 of the other one: the mean
/// specific force feels what lies between besides, b = 1 / 2 n - sqrt(3) / 2 of the other. Turns
/// phi, at the nodes of the interval, by that [rad/s]; the attitude at the end, which does not feel
/// it, is no longer in it.
void turn_between_ends(const Interval& interval, const Timeline& timeline, const Vec3& b,
                       Vec3* phi);

}  // namespace drift
