#pragma once

#include "core/estimate/estimate_result.hpp"
#include "core/sim/simulate.hpp"

namespace drift::bench {

/// A Monte Carlo run as it is written without driftscope: SUNDIALS' CVODE as packaged, set up anew
/// for every run, and a dense extended Kalman filter over Eigen matrices. Physics, timeline,
/// tolerances, measurements and linearisation are the same, so the answers are as accurate.

/// phi at every node by CVODE with its own vectors and a fixed-point corrector, one call per node.
/// draw: the numbers of the run. Algebraic couplings without process noise.
Trajectory practice_trajectory(const Timeline& timeline, const TruthSpec& truth,
                               const TruthDraw& draw, const OdeOptions& tolerances);

/// Textbook EKF over 3 attitude errors and all parameters with P <- (I - K H) P.
EstimateResult practice_ekf(const FilterSpec& filter, const Timeline& timeline,
                            const Readout& readout, const Measurements& measured,
                            const Theta& start);

/// The same, then whole passes linearised about the parameters of the one before, until none moves
/// by a posterior sigma; sixteen at most, as IteratedPasses.
EstimateResult practice_iterated(const FilterSpec& filter, const Timeline& timeline,
                                 const Readout& readout, const Measurements& measured,
                                 const Theta& start);

}  // namespace drift::bench
