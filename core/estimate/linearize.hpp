#pragma once

#include <vector>

#include "core/estimate/linearizer.hpp"

namespace drift {

/// Sensitivities within one interval, from its start to each of its nodes:
/// psi(node k) = Phi[k] psi(start) + G[k] x(rate states).
struct IntervalSensitivity {
  std::vector<NodeJacobian> jacobian;  ///< at each node
  std::vector<Mat3> Phi;
  std::vector<Mat3X> G;
};

/// Mean of the accelerometer outputs over an interval, and its derivative with respect to the
/// attitude in the middle.
struct MeanOutput {
  Vec3 acc = Vec3::Zero();  ///< [g]
  Mat3 H = Mat3::Zero();    ///< [g/rad]
};

/// Also gathers the mean of H_par, in sensitivity.jacobian[0].H_par (it allocates nothing).
MeanOutput mean_output(const Interval& interval, IntervalSensitivity& sensitivity);

/// Fills `out` along the nodes of an interval, phi given at each.
///
/// Variation of constants: G(t) = Phi(t) Int Phi^-1 B dt with fourth-order quadrature over pairs of
/// steps; Phi is the exponential of the integral of A to second order (A t is below 1e-3 within an
/// interval: physics.md 6.5 ii).
/// memory: the points of the interval, null where the model has none.
void linearize_interval(const Interval& interval, const Timeline& timeline, const Mat3& E_loop,
                        const Vec3* phi, const MemoryPoint* memory, Linearizer& linearizer,
                        IntervalSensitivity& out);

}  // namespace drift
