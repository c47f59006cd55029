#include "core/sim/trajectory.hpp"

namespace drift {

Trajectory integrate_fixed(const Timeline& timeline, const DriftModel& model, const Theta& theta,
                           const std::vector<Vec3>& psi0_l) {
  Trajectory all(timeline.nodes.size());
  walk(timeline, model, theta, psi0_l,
       [&](std::size_t i, const std::vector<Vec3>& phi, const MemoryPath&) {
         std::copy(phi.begin(), phi.end(), &all[timeline.intervals[i].first_node]);
       });
  return all;
}

}  // namespace drift
