#pragma once

#include "core/estimate/batch.hpp"

namespace drift {

/// Makes the rows of a test white where noise of the gyros has moved the platform since its caging:
/// every column of a chain runs through the innovations of a Kalman filter with gains that depend
/// on the noise alone. Its states are what the noise has made of the attitude, and its value
/// in the sample (HeldNoise). The attitude at caging stays an unknown of the rows.
///
/// walk: of each axis [rad/sqrt(s)]; sigma_psi: of the attitude's prior, whose units the rows are
/// in [rad]. None comes at rest. What comes late is carried back to the caging, as the rows'
/// derivatives are: the platform holds inertial space to first order. attitudes: of each chain,
/// what its rows feel of the attitude, shape (rows, 3); kept from one point for all of a descent,
/// they make its cost one function.
void whiten_random_walk(const MeasuredTest& test, double walk, double sigma_psi,
                        const std::vector<MatX>& attitudes, std::vector<ChainEquations>& chains);

/// The first three columns of each chain's rows.
std::vector<MatX> attitude_columns(const std::vector<ChainEquations>& chains);

}  // namespace drift
