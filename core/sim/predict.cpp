#include "core/sim/predict.hpp"

#include <limits>

#include "core/base/check.hpp"
#include "core/sim/instruments.hpp"

namespace drift {

Measurements predict(const Timeline& timeline, const DriftModel& model, const Theta& theta,
                     const std::vector<Vec3>& psi0_l, const Readout& readout, Trajectory* phi) {
  DRIFT_EXPECTS(model.coupling != Coupling::servo);
  require_covariates(model, timeline);
  const auto n = static_cast<Eigen::Index>(timeline.intervals.size());
  const double missing = std::numeric_limits<double>::quiet_NaN();
  Measurements out{Mat3X::Constant(3, n, missing), Mat3X::Constant(3, n, missing)};
  if (phi) phi->assign(timeline.nodes.size(), Vec3::Zero());
  const Instruments instruments{&timeline, &model, theta.data()};
  MemoryPath path(timeline, model);
  const auto memory = [&](std::size_t k) {
    return path.active() ? path.at(2 * k).value.data() : nullptr;
  };
  std::vector<Vec3> nodes;
  Vec3 last = Vec3::Zero();
  for (std::size_t i = 0; i < timeline.intervals.size(); ++i) {
    const Interval& interval = timeline.intervals[i];
    path.advance(i, theta.data());
    if (interval.cage)
      last = caged_phi(timeline.nodes[interval.first_node].R_lr, psi0_l[interval.chain]);
    nodes.resize(interval.node_count());
    nodes[0] = last;
    step_through(interval, timeline, drive_of(interval, timeline, model, theta), nodes.data(), 0,
                 &path);
    last = nodes.back();
    const auto column = static_cast<Eigen::Index>(i);
    if (readout.accelerometers)
      out.acc.col(column) = instruments.accelerometers(interval, nodes.data(), memory);
    if (readout.gimbals)
      out.gimbal.col(column) = instruments.gimbals(interval, nodes.data(), memory);
    if (phi)
      std::copy(nodes.begin(), nodes.end(), phi->begin() + static_cast<long>(interval.first_node));
  }
  return out;
}

}  // namespace drift
