#include "analysis/strapdown/case_errors.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/estimate/strapdown/accelerometer_fit.hpp"
#include "core/sim/predict.hpp"

namespace drift::strapdown {
namespace {

/// Intervals of one dwell, [first, end), and what was measured in it.
struct Stay {
  std::size_t first = 0, end = 0;
  Vec3 acc = Vec3::Zero();        ///< mean output [g]
  Vec3 rest_rate = Vec3::Zero();  ///< mean rate that the model reads out of the gyros [rad/s]
};

std::vector<Stay> stays_of(const CaseTest& test, const Measurements& predicted) {
  std::vector<Stay> stays(static_cast<std::size_t>(test.timeline.positions));
  for (std::size_t i = 0; i < test.timeline.intervals.size(); ++i) {
    const Interval& interval = test.timeline.intervals[i];
    if (!interval.rest) continue;
    Stay& stay = stays[static_cast<std::size_t>(interval.position)];
    if (stay.end == 0) stay.first = i;
    stay.end = i + 1;
    stay.acc += test.measured.acc.col(static_cast<Eigen::Index>(i));
    stay.rest_rate += predicted.gimbal.col(static_cast<Eigen::Index>(i));
  }
  for (Stay& s : stays) {
    const auto n = static_cast<double>(std::max<std::size_t>(1, s.end - s.first));
    s.acc /= n;
    s.rest_rate /= n;
  }
  return stays;
}

}  // namespace

CaseErrors case_errors(const CaseTest& test, const DriftModel& model, const Theta& theta,
                       const std::vector<Vec3>& psi0_l) {
  const Timeline& timeline = test.timeline;
  Trajectory phi;
  const Measurements predicted = predict(timeline, model, theta, psi0_l, test.readout, &phi);
  const std::vector<Stay> stays = stays_of(test, predicted);
  const SpecificForce force(theta);
  MemoryRecord memory(timeline, model);
  memory.trace(theta.data());
  CaseErrors out;
  for (const Stay& s : stays) {
    out.gyro.push_back(s.rest_rate.norm() / std::sqrt(3.0));
    out.gravity.push_back(std::abs(force(s.acc).norm() - 1.0));
  }
  for (const std::size_t d : test.ways) {
    const Stay &from = stays[d - 1], &to = stays[d];
    const std::size_t node = timeline.intervals[from.end - 1].last_node();
    const Mat3& R_lr = timeline.nodes[node].R_lr;
    const Mat3 R = R_lr * rotation(phi[node]);
    // The least turn that levels it.
    const Vec3 up_seen_l = R * force(from.acc).normalized();
    const Mat3 level = Eigen::Quaterniond::FromTwoVectors(up_seen_l, up_l).toRotationMatrix();
    Vec3 now = rotation_vector(R_lr.transpose() * level * R);
    std::vector<Vec3> on_the_way;
    std::size_t last = node;
    for (std::size_t i = from.end; i < to.first; ++i) {
      const Interval& interval = timeline.intervals[i];
      on_the_way.assign(interval.node_count(), now);
      step_through(interval, timeline, drive_of(interval, timeline, model, theta),
                   memory.points(interval), on_the_way.data());
      now = on_the_way.back();
      last = interval.last_node();
    }
    const Vec3 up = (timeline.nodes[last].R_lr * rotation(now)).transpose() * up_l;
    const Vec3 seen = force(to.acc).normalized();
    out.up.push_back(std::atan2(up.cross(seen).norm(), up.dot(seen)));
  }
  return out;
}

}  // namespace drift::strapdown
