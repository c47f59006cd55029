#include "core/estimate/sequential/reference_path.hpp"

namespace drift {

ReferencePath::ReferencePath(const Timeline& timeline, const DriftModel& model)
    : timeline_(timeline),
      model_(model),
      memory_(timeline, model),
      in_lanes_(all_in_lanes(model.terms)),
      lanes_(timeline, model),
      ends_(static_cast<std::size_t>(timeline.chains), Vec3::Zero()),
      phi_(timeline.nodes.size(), Vec3::Zero()) {}

void ReferencePath::place(const Theta& theta) {
  const auto& intervals = timeline_.intervals;
  if (in_lanes_) {
    lanes_.set_theta(theta);
    for (std::size_t end = intervals.size(), first = end; end > 0; end = first) {
      while (!intervals[--first].cage && first > 0) {
      }
      phi_[intervals[end - 1].last_node()] =
          ends_[static_cast<std::size_t>(intervals[first].chain)];
      lanes_.backward(first, end, phi_.data());
    }
    return;
  }
  memory_.trace(theta.data());
  Vec3 phi = Vec3::Zero();
  for (std::size_t i = intervals.size(); i-- > 0;) {
    const Interval& interval = intervals[i];
    if (i + 1 == intervals.size() || intervals[i + 1].cage)
      phi = ends_[static_cast<std::size_t>(interval.chain)];
    phi_[interval.last_node()] = phi;
    step_back_through(interval, timeline_, drive_of(interval, timeline_, model_, theta),
                      memory_.steps(interval), &phi_[interval.first_node]);
    phi = phi_[interval.first_node];
  }
}

}  // namespace drift
