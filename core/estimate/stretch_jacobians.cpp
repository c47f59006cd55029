#include "core/estimate/stretch_jacobians.hpp"

namespace drift {
namespace {

bool alike(const Interval& a, const Interval& b) {
  return a.omega_cmd_p == b.omega_cmd_p && a.loop == b.loop;
}

}  // namespace

void StretchJacobians::evaluate(std::size_t first, std::size_t end, const Vec3* path,
                                const Mounting& mounting, Linearizer& linearizer) {
  first_ = first;
  offset_.clear();
  std::array<NodePoint, Linearizer::at_once> points;
  std::size_t waiting = 0, done = 0;
  const auto work_out = [&] {
    if (waiting == 0) return;
    while (all_.size() < done + waiting) all_.push_back(linearizer.make());
    linearizer.evaluate({points.data(), waiting},
                        misalignment_matrix(mounting, points[0].interval->loop), &timeline_,
                        &all_[done]);
    done += waiting;
    waiting = 0;
  };
  for (std::size_t i = first; i < end; ++i) {
    const Interval& interval = timeline_.intervals[i];
    const Interval* before = i > first ? &timeline_.intervals[i - 1] : nullptr;
    if (before && !alike(*before, interval)) work_out();
    const Node* nodes = &timeline_.nodes[interval.first_node];
    const bool shared = before && !interval.cage && alike(*before, interval) &&
                        timeline_.nodes[before->last_node()].omega_ic_l == nodes->omega_ic_l;
    offset_.push_back(done + waiting - (shared ? 1 : 0));
    for (std::size_t k = shared ? 1 : 0; k < interval.node_count(); ++k) {
      points[waiting++] = {nodes + k, &interval, path[interval.first_node + k]};
      if (waiting == points.size()) work_out();
    }
  }
  work_out();
}

}  // namespace drift
