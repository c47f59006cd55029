#pragma once

#include "core/estimate/batch.hpp"

namespace drift {

/// Makes the rows of a test white where angle random walk has moved the platform since its caging:
/// every column of a chain runs through the innovations of a Kalman filter whose three states are
/// what the walk has made of the attitude, with gains that depend on the noise alone. The attitude
/// at caging stays an unknown of the rows.
///
/// walk: of each axis, in units of the attitude's prior [1/sqrt(s)]. Half of an interval's noise
/// comes before its accelerometers, half before its gimbal angles, as in IntervalStep; none comes
/// at rest. What comes late is carried back to the caging, as the rows' derivatives are: the
/// platform holds inertial space to first order. attitudes: of each chain, what its rows feel of
/// the attitude, shape (rows, 3); kept from one point for all of a descent, they make its cost one
/// function.
void whiten_random_walk(const MeasuredTest& test, double walk, const std::vector<MatX>& attitudes,
                        std::vector<ChainEquations>& chains);

/// The first three columns of each chain's rows.
std::vector<MatX> attitude_columns(const std::vector<ChainEquations>& chains);

}  // namespace drift
