#include "core/sim/trajectory.hpp"

#include <algorithm>

namespace drift {

Drive drive_of(const Interval& interval, const Timeline& timeline, const DriftModel& model,
               const Theta& theta) {
  Drive d;
  d.model = &model;
  d.theta = theta.data();
  d.omega_ic_l = timeline.nodes[interval.first_node].omega_ic_l;
  d.omega_ie_l = timeline.site.omega_ie_l();
  d.omega_cmd_p = interval.omega_cmd_p;
  d.E_loop = misalignment_matrix(model.mounting, interval.loop);
  d.needs = TermLibrary::needs(model.terms);
  d.timeline = &timeline;
  d.interval = &interval;
  return d;
}

Vec3 step_attitude(const Drive& drive, double t, double step, const Vec3& phi,
                   const StepPoint& from, const StepPoint& half, const StepPoint& to) {
  const auto rate = [&](const StepPoint& at, double time, const Vec3& chi) {
    return attitude_rate_l(drive, at.R_lr, chi, time,
                           at.memory ? at.memory->value.data() : nullptr);
  };
  const Vec3 chi = from.R_lr * phi;
  const Vec3 k1 = rate(from, t, chi);
  const Vec3 k2 = rate(half, t + 0.5 * step, chi + 0.5 * step * k1);
  const Vec3 k3 = rate(half, t + 0.5 * step, chi + 0.5 * step * k2);
  const Vec3 k4 = rate(to, t + step, chi + step * k3);
  return to.R_lr.transpose() * (chi + step / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4));
}

void step_through(const Interval& interval, const Timeline& timeline, const Drive& drive,
                  const StepMemory* memory, Vec3* out, std::size_t from) {
  if (interval.rest) {
    std::fill(out + from + 1, out + interval.node_count(), out[from]);
    return;
  }
  const double step = interval.length() / (2.0 * interval.substeps);
  for (std::size_t k = from; k + 1 < interval.node_count(); ++k) {
    const Node* node = &timeline.nodes[interval.first_node + k];
    const StepMemory* past = memory ? memory + k : nullptr;
    out[k + 1] =
        step_attitude(drive, node->t, step, out[k], {node->R_lr, past ? &past->begin : nullptr},
                      {node->R_lr_half, past ? &past->half : nullptr},
                      {node[1].R_lr, past ? &past->end : nullptr});
  }
}

void step_back_through(const Interval& interval, const Timeline& timeline, const Drive& drive,
                       const StepMemory* memory, Vec3* out) {
  if (interval.rest) {
    std::fill(out, out + interval.node_count() - 1, out[interval.node_count() - 1]);
    return;
  }
  const double step = interval.length() / (2.0 * interval.substeps);
  for (std::size_t k = interval.node_count() - 1; k-- > 0;) {
    const Node* node = &timeline.nodes[interval.first_node + k];
    const StepMemory* past = memory ? memory + k : nullptr;
    out[k] = step_attitude(drive, node[1].t, -step, out[k + 1],
                           {node[1].R_lr, past ? &past->end : nullptr},
                           {node->R_lr_half, past ? &past->half : nullptr},
                           {node->R_lr, past ? &past->begin : nullptr});
  }
}

Vec3 caged_phi(const Mat3& R_lr, const Vec3& psi_l) {
  return R_lr.transpose() * psi_l;
}

Vec3 turned(const Node& node, const Vec3& psi_i, const Vec3& phi) {
  const Vec3 psi_r = node.R_lr.transpose() * (node.R_il.transpose() * psi_i);
  return rotation_vector(rotation(psi_r) * rotation(phi));
}

Trajectory integrate_fixed(const Timeline& timeline, const DriftModel& model, const Theta& theta,
                           const std::vector<Vec3>& psi0_l) {
  require_covariates(model, timeline);
  const auto& intervals = timeline.intervals;
  Trajectory all(timeline.nodes.size());
  MemoryPath memory(timeline, model);
  for (std::size_t n = 0; n < intervals.size(); ++n) {
    const Interval& i = intervals[n];
    Vec3& begin = all[i.first_node];
    memory.advance(n, theta.data());
    begin = n > 0 ? all[intervals[n - 1].last_node()] : Vec3(Vec3::Zero());
    if (i.cage)
      begin =
          caged_phi(timeline.nodes[i.first_node].R_lr, psi0_l[static_cast<std::size_t>(i.chain)]);
    step_through(i, timeline, drive_of(i, timeline, model, theta), memory.steps(), &begin);
  }
  return all;
}

}  // namespace drift
