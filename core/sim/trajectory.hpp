#pragma once

#include <vector>

#include "core/sim/kinematics.hpp"
#include "core/sim/memory_path.hpp"

namespace drift {

/// The platform's motion: rotation vector phi against the reference at every node of a timeline
/// [rad].
using Trajectory = std::vector<Vec3>;

/// Drive of an interval without process noise.
inline Drive drive_of(const Interval& interval, const Timeline& timeline, const DriftModel& model,
                      const Theta& theta) {
  Drive d;
  d.model = &model;
  d.theta = theta.data();
  d.omega_ic_l = timeline.nodes[interval.first_node].omega_ic_l;
  d.omega_cmd_p = interval.omega_cmd_p;
  d.E_loop = misalignment_matrix(model.mounting, interval.loop);
  d.needs = TermLibrary::needs(model.terms);
  d.timeline = &timeline;
  d.interval = &interval;
  return d;
}

/// One classical Runge-Kutta step from node k of an interval to the next, `step` later. memory: of
/// that interval, if the model has any.
inline Vec3 step_attitude(const Drive& drive, const Node* node, double step, const Vec3& phi,
                          std::size_t k = 0, const MemoryPath* memory = nullptr) {
  const bool remembers = memory && memory->active();
  const auto recall = [&](std::size_t point) {
    return remembers ? memory->at(2 * k + point).value.data() : nullptr;
  };
  const double t = node->t;
  const Vec3 k1 = attitude_rate(drive, node->R_lr, phi, t, recall(0));
  const Vec3 k2 =
      attitude_rate(drive, node->R_lr_half, phi + 0.5 * step * k1, t + 0.5 * step, recall(1));
  const Vec3 k3 =
      attitude_rate(drive, node->R_lr_half, phi + 0.5 * step * k2, t + 0.5 * step, recall(1));
  const Vec3 k4 = attitude_rate(drive, node[1].R_lr, phi + step * k3, t + step, recall(2));
  return phi + step / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
}

/// phi at the nodes of one interval after the first, whose phi is given in out[0].
inline void step_through(const Interval& interval, const Timeline& timeline, const Drive& drive,
                         Vec3* out, std::size_t from = 0, const MemoryPath* memory = nullptr) {
  const double step = interval.length() / (2.0 * interval.substeps);
  for (std::size_t k = from; k + 1 < interval.node_count(); ++k)
    out[k + 1] =
        step_attitude(drive, &timeline.nodes[interval.first_node + k], step, out[k], k, memory);
}

/// The same backwards: phi at `node` from phi at the node after it.
inline Vec3 step_attitude_back(const Drive& drive, const Node* node, double step, const Vec3& phi) {
  const Vec3 k1 = attitude_rate(drive, node[1].R_lr, phi);
  const Vec3 k2 = attitude_rate(drive, node->R_lr_half, phi - 0.5 * step * k1);
  const Vec3 k3 = attitude_rate(drive, node->R_lr_half, phi - 0.5 * step * k2);
  const Vec3 k4 = attitude_rate(drive, node->R_lr, phi - step * k3);
  return phi - step / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
}

/// Initial rotation vector of a chain whose attitude error is psi in local axes:
/// R_lp = exp([psi x]) R_lr = R_lr exp([phi x]).
inline Vec3 caged_phi(const Mat3& R_lr, const Vec3& psi_l) {
  return R_lr.transpose() * psi_l;
}

/// Fixed-step integration of the algebraic couplings over a whole timeline, fourth order, two steps
/// per substep. psi0_l: initial attitude error of each chain, local axes [rad].
/// The estimators use it; it agrees with CVODE at 1e-10 to 1e-5 arcsec (tests).
Trajectory integrate_fixed(const Timeline& timeline, const DriftModel& model, const Theta& theta,
                           const std::vector<Vec3>& psi0_l);

}  // namespace drift
