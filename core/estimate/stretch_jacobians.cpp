#include "core/estimate/stretch_jacobians.hpp"

#include "core/sim/surroundings.hpp"

namespace drift {
namespace {

/// Whether two intervals may be worked out at once.
bool alike(const Interval& a, const Interval& b) {
  return a.omega_cmd_p == b.omega_cmd_p && a.loop == b.loop;
}

}  // namespace

/// Whether a's last node is b's first: all that the terms see there is the same.
bool StretchJacobians::shared(const Interval& a, const Interval& b,
                              const MemoryRecord* memory) const {
  const MemoryPoint* left = memory ? memory->points(b) : nullptr;
  if (left && left->value != memory->points(a)[2 * (a.node_count() - 1)].value) return false;
  return !b.cage && alike(a, b) &&
         timeline_.nodes[a.last_node()].omega_ic_l == timeline_.nodes[b.first_node].omega_ic_l &&
         (attitude_alone_ || moment_at(timeline_, a, a.t1) == moment_at(timeline_, b, b.t0));
}

void StretchJacobians::evaluate(std::size_t first, std::size_t end, const Vec3* path,
                                Linearizer& linearizer, const MemoryRecord* memory) {
  first_ = first;
  offset_.clear();
  std::array<NodePoint, Linearizer::at_once> points;
  std::size_t waiting = 0, done = 0;
  const auto work_out = [&] {
    if (waiting == 0) return;
    while (all_.size() < done + waiting) all_.push_back(linearizer.make());
    linearizer.evaluate({points.data(), waiting},
                        misalignment_matrix(mounting_, points[0].interval->loop), &timeline_,
                        &all_[done]);
    done += waiting;
    waiting = 0;
  };
  for (std::size_t i = first; i < end; ++i) {
    const Interval& interval = timeline_.intervals[i];
    const Interval* before = i > first ? &timeline_.intervals[i - 1] : nullptr;
    if (before && !alike(*before, interval)) work_out();
    const Node* nodes = &timeline_.nodes[interval.first_node];
    const std::size_t begin = before && shared(*before, interval, memory) ? 1 : 0;
    const MemoryPoint* left = memory ? memory->points(interval) : nullptr;
    offset_.push_back(done + waiting - begin);
    for (std::size_t k = begin; k < interval.node_count(); ++k) {
      points[waiting++] = {nodes + k, &interval, path[interval.first_node + k],
                           left ? left + 2 * k : nullptr};
      if (waiting == points.size()) work_out();
    }
  }
  work_out();
}

}  // namespace drift
