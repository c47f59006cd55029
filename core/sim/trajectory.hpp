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

/// Where a step begins, its half way or its end: the reference attitude and the memory, null where
/// the model has none.
struct StepPoint {
  const Mat3& R_lr;
  const MemoryPoint* memory;
};

/// One classical Runge-Kutta step from t on; backwards where `step` is negative.
Vec3 step_attitude(const Drive& drive, double t, double step, const Vec3& phi,
                   const StepPoint& from, const StepPoint& half, const StepPoint& to);

/// phi at the nodes of one interval after number `from`, whose phi is given in out[from]. memory:
/// of the steps of the interval, null where the model has none.
void step_through(const Interval& interval, const Timeline& timeline, const Drive& drive,
                  const StepMemory* memory, Vec3* out, std::size_t from = 0);

/// The same backwards: phi at the nodes before the last, whose phi is given.
void step_back_through(const Interval& interval, const Timeline& timeline, const Drive& drive,
                       const StepMemory* memory, Vec3* out);

/// Initial rotation vector of a chain whose attitude error is psi in local axes:
/// R_lp = exp([psi x]) R_lr = R_lr exp([phi x]).
Vec3 caged_phi(const Mat3& R_lr, const Vec3& psi_l);

/// phi with the attitude turned by a small rotation psi_i, axes of the chain's inertial frame
/// [rad].
Vec3 turned(const Node& node, const Vec3& psi_i, const Vec3& phi);

/// Fixed-step integration of the algebraic couplings over a whole timeline, fourth order, two steps
/// per substep. psi0_l: initial attitude error of each chain, local axes [rad]. What is predicted
/// is predicted along it, whatever the terms; it agrees with CVODE at 1e-10 to 1e-3 arcsec (tests).
Trajectory integrate_fixed(const Timeline& timeline, const DriftModel& model, const Theta& theta,
                           const std::vector<Vec3>& psi0_l);

/// Calls visit(i, phi, memory) for interval after interval of that path, phi at its nodes.
template <class Visit>
void walk(const Timeline& timeline, const DriftModel& model, const Theta& theta,
          const std::vector<Vec3>& psi0_l, Visit&& visit) {
  const Trajectory all = integrate_fixed(timeline, model, theta, psi0_l);
  MemoryPath memory(timeline, model);
  std::vector<Vec3> phi;
  for (std::size_t n = 0; n < timeline.intervals.size(); ++n) {
    const Interval& i = timeline.intervals[n];
    memory.advance(n, theta.data());
    phi.assign(&all[i.first_node], &all[i.first_node] + i.node_count());
    visit(n, phi, memory);
  }
}

}  // namespace drift
