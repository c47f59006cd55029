#include "core/sim/trajectory.hpp"

namespace drift {

Trajectory integrate_fixed(const Timeline& timeline, const DriftModel& model, const Theta& theta,
                           const std::vector<Vec3>& psi0_l) {
  Trajectory phi(timeline.nodes.size());
  Vec3 last = Vec3::Zero();
  for (const Interval& i : timeline.intervals) {
    if (i.cage) last = caged_phi(timeline.nodes[i.first_node].R_lr, psi0_l[i.chain]);
    Vec3* out = &phi[i.first_node];
    out[0] = last;
    step_through(i, timeline, drive_of(i, timeline, model, theta), out);
    last = out[i.node_count() - 1];
  }
  return phi;
}

}  // namespace drift
