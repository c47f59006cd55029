#pragma once

#include <vector>

#include "core/sim/kinematics.hpp"
#include "core/sim/memory_path.hpp"

namespace drift {

/// The platform's motion: rotation vector phi against the reference at every node of a timeline
/// [rad].
using Trajectory = std::vector<Vec3>;

/// Drive of an interval without process noise.
Drive drive_of(const Interval& interval, const Timeline& timeline, const DriftModel& model,
               const Theta& theta);

/// One classical Runge-Kutta step from node k of an interval to the next, `step` later. memory: of
/// that interval, if the model has any.
Vec3 step_attitude(const Drive& drive, const Node* node, double step, const Vec3& phi,
                   std::size_t k = 0, const MemoryPath* memory = nullptr);

/// phi at the nodes of one interval after the first, whose phi is given in out[0].
void step_through(const Interval& interval, const Timeline& timeline, const Drive& drive, Vec3* out,
                  std::size_t from = 0, const MemoryPath* memory = nullptr);

/// The same backwards: phi at `node` from phi at the node after it.
Vec3 step_attitude_back(const Drive& drive, const Node* node, double step, const Vec3& phi);

/// Initial rotation vector of a chain whose attitude error is psi in local axes:
/// R_lp = exp([psi x]) R_lr = R_lr exp([phi x]).
Vec3 caged_phi(const Mat3& R_lr, const Vec3& psi_l);

/// Fixed-step integration of the algebraic couplings over a whole timeline, fourth order, two steps
/// per substep. psi0_l: initial attitude error of each chain, local axes [rad].
/// The estimators use it; it agrees with CVODE at 1e-10 to 1e-5 arcsec (tests).
Trajectory integrate_fixed(const Timeline& timeline, const DriftModel& model, const Theta& theta,
                           const std::vector<Vec3>& psi0_l);

}  // namespace drift
