#include "core/sim/predict.hpp"

#include <limits>

#include "core/base/check.hpp"
#include "core/sim/instruments.hpp"

namespace drift {

Measurements predict(const Timeline& timeline, const DriftModel& model, const Theta& theta,
                     const std::vector<Vec3>& psi0_l, const Readout& readout, Trajectory* phi) {
  DRIFT_EXPECTS(model.coupling != Coupling::servo);
  const auto n = static_cast<Eigen::Index>(timeline.intervals.size());
  const double missing = std::numeric_limits<double>::quiet_NaN();
  Measurements out{Mat3X::Constant(3, n, missing), Mat3X::Constant(3, n, missing)};
  if (phi) phi->assign(timeline.nodes.size(), Vec3::Zero());
  const Instruments instruments{&timeline, &model, theta.data()};
  walk(timeline, model, theta, psi0_l,
       [&](std::size_t i, const std::vector<Vec3>& nodes, const MemoryPath& path) {
         const Interval& interval = timeline.intervals[i];
         const auto memory = [&](std::size_t k) {
           return path.active() ? path.points()[2 * k].value.data() : nullptr;
         };
         const auto column = static_cast<Eigen::Index>(i);
         if (readout.accelerometers)
           out.acc.col(column) = instruments.accelerometers(interval, nodes.data(), memory);
         if (readout.gimbals)
           out.gimbal.col(column) = interval.rest
                                        ? instruments.rest_rate(interval, nodes.data(), memory)
                                        : instruments.gimbals(interval, nodes.data(), memory);
         if (phi) std::copy(nodes.begin(), nodes.end(), &(*phi)[interval.first_node]);
       });
  return out;
}

}  // namespace drift
