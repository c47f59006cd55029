#include "core/sim/trajectory.hpp"

namespace drift {

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
