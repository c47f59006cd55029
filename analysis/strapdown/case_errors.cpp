#include "analysis/strapdown/case_errors.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/nan.hpp"
#include "core/estimate/strapdown/accelerometer_fit.hpp"
#include "core/sim/predict.hpp"

namespace drift::strapdown {
namespace {

/// Rows of one dwell, [first, end), and what was measured in it.
struct Stay {
  std::size_t first = 0, end = 0;
  Vec3 acc = Vec3::Zero();            ///< mean output [g]
  Vec3 at_start = acc, at_end = acc;  ///< where the unit did not stand still: of the outer rows
  Vec3 rest_rate = Vec3::Zero();      ///< mean rate that the model reads out of the gyros [rad/s]
};

/// What the accelerometers read with what SpecificForce does not know (temperatures, lever arms, a
/// ramp) taken out [g]: of the model, at the attitude that it has.
Mat3X read_without_others(const CaseTest& test, const DriftModel& model, const Theta& theta,
                          const std::vector<Vec3>& psi0_l, const Measurements& predicted) {
  Theta known = theta;
  bool others = false;
  for (std::size_t t = 0; t < TermLibrary::num_terms; ++t) {
    const TermInfo& term = TermLibrary::terms[t];
    if (!model.terms[t] || !term.in_readout || term.in_rates || term.in_offset ||
        term.key == terms::Accelerometer::key)
      continue;
    others = true;
    std::fill_n(known.data() + term.first, term.count, 0.0);
  }
  if (!others) return test.measured.acc;
  const Measurements without = predict(test.timeline, model, known, psi0_l, test.readout);
  return test.measured.acc - (predicted.acc - without.acc);
}

std::vector<Stay> stays_of(const CaseTest& test, const Measurements& predicted, const Mat3X& acc) {
  std::vector<Stay> stays(static_cast<std::size_t>(test.timeline.positions));
  for (std::size_t i = 0; i < test.timeline.intervals.size(); ++i) {
    const Interval& interval = test.timeline.intervals[i];
    if (interval.slew) continue;
    const auto column = static_cast<Eigen::Index>(i);
    Stay& stay = stays[static_cast<std::size_t>(interval.position)];
    if (stay.end == 0) {
      stay.first = i;
      stay.at_start = acc.col(column);
    }
    stay.end = i + 1;
    stay.at_end = acc.col(column);
    stay.acc += acc.col(column);
    if (interval.rest) stay.rest_rate += predicted.gimbal.col(column);
  }
  for (std::size_t d = 0; d < stays.size(); ++d) {
    Stay& s = stays[d];
    const auto n = static_cast<double>(std::max<std::size_t>(1, s.end - s.first));
    s.acc /= n;
    s.rest_rate /= n;
    if (test.still[d]) s.at_start = s.at_end = s.acc;
  }
  return stays;
}

}  // namespace

CaseErrors case_errors(const CaseTest& test, const DriftModel& model, const Theta& theta,
                       const std::vector<Vec3>& psi0_l) {
  const Timeline& timeline = test.timeline;
  Trajectory phi;
  const Measurements predicted = predict(timeline, model, theta, psi0_l, test.readout, &phi);
  const std::vector<Stay> stays =
      stays_of(test, predicted, read_without_others(test, model, theta, psi0_l, predicted));
  const SpecificForce force(theta);
  MemoryRecord memory(timeline, model);
  memory.trace(theta.data());
  CaseErrors out;
  for (std::size_t d = 0; d < stays.size(); ++d) {
    const Stay& s = stays[d];
    out.gyro.push_back(test.still[d] ? s.rest_rate.norm() / std::sqrt(3.0) : nan_value);
    out.gravity.push_back(std::abs(force(s.acc).norm() - 1.0));
  }
  for (const std::size_t d : test.ways) {
    const Stay &from = stays[d - 1], &to = stays[d];
    const Interval& leaving = timeline.intervals[from.end - 1];
    const auto attitude = [&](std::size_t node) -> Mat3 {
      return timeline.nodes[node].R_lr * rotation(phi[node]);
    };
    // The least turn that levels it.
    const Vec3 up_seen_l = attitude(leaving.middle_node()) * force(from.at_end).normalized();
    const Mat3 level = Eigen::Quaterniond::FromTwoVectors(up_seen_l, up_l).toRotationMatrix();
    const std::size_t node = leaving.last_node();
    Vec3 now = rotation_vector(timeline.nodes[node].R_lr.transpose() * level * attitude(node));
    std::size_t seen_at = node;  // where gravity is seen again: in the middle of the first row
    Vec3 then = now;
    std::vector<Vec3> nodes;
    for (std::size_t i = from.end; i < to.first + (test.still[d] ? 0 : 1); ++i) {
      const Interval& interval = timeline.intervals[i];
      nodes.assign(interval.node_count(), now);
      step_through(interval, timeline, drive_of(interval, timeline, model, theta),
                   memory.steps(interval), nodes.data());
      now = nodes.back();
      seen_at = i < to.first ? interval.last_node() : interval.middle_node();
      then = i < to.first ? now : nodes[static_cast<std::size_t>(interval.substeps)];
    }
    const Vec3 up = (timeline.nodes[seen_at].R_lr * rotation(then)).transpose() * up_l;
    const Vec3 seen = force(to.at_start).normalized();
    out.up.push_back(std::atan2(up.cross(seen).norm(), up.dot(seen)));
  }
  return out;
}

}  // namespace drift::strapdown
