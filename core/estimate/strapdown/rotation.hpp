#pragma once

#include <span>
#include <vector>

#include "core/estimate/strapdown/accelerometer_fit.hpp"
#include "core/estimate/strapdown/dwell_drift.hpp"
#include "core/estimate/strapdown/dwells.hpp"
#include "core/physics/drift_model.hpp"

namespace drift::strapdown {

/// A turn of the case from one dwell to the next: what the gyros said, and gravity before and
/// after.
struct Rotation {
  std::size_t before = 0, after = 0;  ///< numbers of the two dwells
  std::vector<double> dt;             ///< steps [s]
  std::vector<Vec3> theta_g;  ///< gyro output integrated over each step, coning included [rad]
  std::vector<Vec3> f_c;      ///< mean specific force over each step, case axes [g]
  Vec3 up_before, up_after;   ///< unit vectors up at rest, case axes
};

/// The turns between dwells that follow each other. A turn with a sample not measured or a gap in
/// time is left out and counted.
struct Rotations {
  std::vector<Rotation> all;
  std::size_t omitted = 0;
};

/// With accelerometer outputs for specific force, as they are. Each step joins two samples: the
/// trapezoid and the coning term w_a x w_b dt^2 / 12.
Rotations find_rotations(const Signals& signals, std::span<const Dwell> dwells);

/// The turn with calibrated specific force in place of accelerometer outputs.
Rotation calibrated(const Rotation& raw, std::span<const Dwell> dwells, const SpecificForce& force);

/// The turn with the drift of theta taken out of the gyro outputs.
Rotation without_drift(Rotation rotation, const Theta& theta);

/// Where up points in the case after a turn, from the gyros alone.
struct Prediction {
  Vec3 up;        ///< unit vector, case axes
  MatX jacobian;  ///< d up / d theta, a column for each parameter asked for
};

/// Eq. (5): w_g = (I + S) C w_ic + w_l, so  w_ic = C^-1 (I + S)^-1 (w_g - w_l).
/// Eq. (6): misalignment has no part in case motion, and the drift it turns, C^-1 w_l, is what the
/// dwells measure as a whole: w_ic = (I + S)^-1 (w_g - w_l), whatever eta and xi are.
/// The parameters may be D_..., s, eta, xi.
Prediction predict(const Rotation& rotation, Coupling equation, const Theta& theta,
                   std::span<const std::size_t> params);

/// Angle between the predicted and the seen direction up after the turn [rad].
double prediction_error(const Rotation& rotation, Coupling equation, const Theta& theta);

}  // namespace drift::strapdown
