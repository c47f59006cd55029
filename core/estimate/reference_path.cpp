#include "core/estimate/reference_path.hpp"

namespace drift {

ReferencePath::ReferencePath(const Timeline& timeline, const DriftModel& model)
    : timeline_(timeline),
      model_(model),
      memory_(timeline, model),
      ends_(static_cast<std::size_t>(timeline.chains), Vec3::Zero()),
      phi_(timeline.nodes.size(), Vec3::Zero()) {}

void ReferencePath::place(const Theta& theta) {
  const auto& intervals = timeline_.intervals;
  memory_.trace(theta.data());
  Vec3 phi = Vec3::Zero();
  for (std::size_t i = intervals.size(); i-- > 0;) {
    const Interval& interval = intervals[i];
    if (i + 1 == intervals.size() || intervals[i + 1].cage)
      phi = ends_[static_cast<std::size_t>(interval.chain)];
    phi_[interval.last_node()] = phi;
    step_back_through(interval, timeline_, drive_of(interval, timeline_, model_, theta),
                      memory_.points(interval), &phi_[interval.first_node]);
    phi = phi_[interval.first_node];
  }
}

}  // namespace drift
