#include "core/sim/trajectory.hpp"

namespace drift {

Drive drive_of(const Interval& interval, const Timeline& timeline, const DriftModel& model,
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

Vec3 step_attitude(const Drive& drive, const Node* node, double step, const Vec3& phi,
                   std::size_t k, const MemoryPath* memory) {
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

void step_through(const Interval& interval, const Timeline& timeline, const Drive& drive, Vec3* out,
                  std::size_t from, const MemoryPath* memory) {
  const double step = interval.length() / (2.0 * interval.substeps);
  for (std::size_t k = from; k + 1 < interval.node_count(); ++k)
    out[k + 1] =
        step_attitude(drive, &timeline.nodes[interval.first_node + k], step, out[k], k, memory);
}

Vec3 step_attitude_back(const Drive& drive, const Node* node, double step, const Vec3& phi) {
  const Vec3 k1 = attitude_rate(drive, node[1].R_lr, phi);
  const Vec3 k2 = attitude_rate(drive, node->R_lr_half, phi - 0.5 * step * k1);
  const Vec3 k3 = attitude_rate(drive, node->R_lr_half, phi - 0.5 * step * k2);
  const Vec3 k4 = attitude_rate(drive, node->R_lr, phi - step * k3);
  return phi - step / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
}

Vec3 caged_phi(const Mat3& R_lr, const Vec3& psi_l) {
  return R_lr.transpose() * psi_l;
}

Trajectory integrate_fixed(const Timeline& timeline, const DriftModel& model, const Theta& theta,
                           const std::vector<Vec3>& psi0_l) {
  require_covariates(model, timeline);
  Trajectory phi(timeline.nodes.size());
  MemoryPath memory(timeline, model);
  Vec3 last = Vec3::Zero();
  for (std::size_t n = 0; n < timeline.intervals.size(); ++n) {
    const Interval& i = timeline.intervals[n];
    memory.advance(n, theta.data());
    if (i.cage) last = caged_phi(timeline.nodes[i.first_node].R_lr, psi0_l[i.chain]);
    Vec3* out = &phi[i.first_node];
    out[0] = last;
    step_through(i, timeline, drive_of(i, timeline, model, theta), out, 0, &memory);
    last = out[i.node_count() - 1];
  }
  return phi;
}

}  // namespace drift
