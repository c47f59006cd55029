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

/// Where a step begins, its half way or its end: the reference attitude and the memory, null where
/// the model has none.
struct StepPoint {
  const Mat3& R_lr;
  const MemoryPoint* memory;
};

/// One classical Runge-Kutta step from t on; backwards where `step` is negative.
inline Vec3 step_attitude(const Drive& drive, double t, double step, const Vec3& phi,
                          const StepPoint& from, const StepPoint& half, const StepPoint& to) {
  const auto rate = [&](const StepPoint& at, double time, const Vec3& there) {
    return attitude_rate(drive, at.R_lr, there, time,
                         at.memory ? at.memory->value.data() : nullptr);
  };
  const Vec3 k1 = rate(from, t, phi);
  const Vec3 k2 = rate(half, t + 0.5 * step, phi + 0.5 * step * k1);
  const Vec3 k3 = rate(half, t + 0.5 * step, phi + 0.5 * step * k2);
  const Vec3 k4 = rate(to, t + step, phi + step * k3);
  return phi + step / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
}

/// phi at the nodes of one interval after number `from`, whose phi is given in out[from]. memory:
/// the points of the interval, null where the model has none.
inline void step_through(const Interval& interval, const Timeline& timeline, const Drive& drive,
                         const MemoryPoint* memory, Vec3* out, std::size_t from = 0) {
  const double step = interval.length() / (2.0 * interval.substeps);
  const auto past = [&](std::size_t point) { return memory ? memory + point : nullptr; };
  for (std::size_t k = from; k + 1 < interval.node_count(); ++k) {
    const Node* node = &timeline.nodes[interval.first_node + k];
    out[k + 1] = step_attitude(drive, node->t, step, out[k], {node->R_lr, past(2 * k)},
                               {node->R_lr_half, past(2 * k + 1)}, {node[1].R_lr, past(2 * k + 2)});
  }
}

/// The same backwards: phi at the nodes before the last, whose phi is given.
inline void step_back_through(const Interval& interval, const Timeline& timeline,
                              const Drive& drive, const MemoryPoint* memory, Vec3* out) {
  const double step = interval.length() / (2.0 * interval.substeps);
  const auto past = [&](std::size_t point) { return memory ? memory + point : nullptr; };
  for (std::size_t k = interval.node_count() - 1; k-- > 0;) {
    const Node* node = &timeline.nodes[interval.first_node + k];
    out[k] = step_attitude(drive, node[1].t, -step, out[k + 1], {node[1].R_lr, past(2 * k + 2)},
                           {node->R_lr_half, past(2 * k + 1)}, {node->R_lr, past(2 * k)});
  }
}

/// Initial rotation vector of a chain whose attitude error is psi in local axes:
/// R_lp = exp([psi x]) R_lr = R_lr exp([phi x]).
inline Vec3 caged_phi(const Mat3& R_lr, const Vec3& psi_l) {
  return R_lr.transpose() * psi_l;
}

/// Fixed-step integration of the algebraic couplings over a whole timeline, fourth order, two steps
/// per substep. Calls visit(i, phi, memory) for interval after interval, phi at its nodes.
/// psi0_l: initial attitude error of each chain, local axes [rad].
/// The estimators use it; it agrees with CVODE at 1e-10 to 1e-5 arcsec (tests).
template <class Visit>
void walk(const Timeline& timeline, const DriftModel& model, const Theta& theta,
          const std::vector<Vec3>& psi0_l, Visit&& visit) {
  require_covariates(model, timeline);
  MemoryPath memory(timeline, model);
  std::vector<Vec3> phi{Vec3::Zero()};
  for (std::size_t n = 0; n < timeline.intervals.size(); ++n) {
    const Interval& i = timeline.intervals[n];
    memory.advance(n, theta.data());
    const Vec3 start =
        i.cage ? caged_phi(timeline.nodes[i.first_node].R_lr, psi0_l[i.chain]) : phi.back();
    phi.resize(i.node_count());
    phi[0] = start;
    step_through(i, timeline, drive_of(i, timeline, model, theta), memory.points(), phi.data());
    visit(n, phi, memory);
  }
}

/// The whole of such a trajectory.
Trajectory integrate_fixed(const Timeline& timeline, const DriftModel& model, const Theta& theta,
                           const std::vector<Vec3>& psi0_l);

}  // namespace drift
