#include "core/sim/held_noise.hpp"

#include <numbers>

#include "core/base/linalg.hpp"
#include "core/sim/trajectory.hpp"

namespace drift {
namespace {

using std::numbers::inv_sqrt3, std::numbers::sqrt3;

/// How far noise that is held has turned the platform: its integral in inertial axes, of third
/// order to the middle of a pair of steps and of fourth to its end.
template <class Visit>
void integrate(const Interval& interval, const Timeline& timeline, Visit&& visit) {
  const Node* node = &timeline.nodes[interval.first_node];
  const auto axes = [&](std::size_t k) -> Mat3 { return node[k].R_il * node[k].R_lr; };
  const double h = interval.length() / (2.0 * interval.substeps);
  Mat3 sum = Mat3::Zero(), R0 = axes(0);
  visit(0, sum);
  for (std::size_t k = 0; k + 2 < interval.node_count(); k += 2) {
    const Mat3 R1 = axes(k + 1), R2 = axes(k + 2);
    visit(k + 1, Mat3(sum + h / 12.0 * (5.0 * R0 + 8.0 * R1 - R2)));
    sum += h / 3.0 * (R0 + 4.0 * R1 + R2);
    visit(k + 2, sum);
    R0 = R2;
  }
}

/// Of the specific force of what stands on the Earth, by the attitude's error [g/rad].
Mat3 force_by_attitude(const Node& node) {
  return node.R_lr.transpose() * skew<double>(Vec3::UnitZ()) * node.R_il.transpose();
}

}  // namespace

HeldNoise held_noise(const Interval& interval, const Timeline& timeline) {
  HeldNoise out;
  if (interval.rest) return out;
  Mat3 to_end = Mat3::Zero(), mean_force = Mat3::Zero();
  const auto middle = static_cast<std::size_t>(interval.substeps);
  integrate(interval, timeline, [&](std::size_t k, const Mat3& turned) {
    const Mat3 weighted = Timeline::mean_weight(interval.substeps, k) *
                          force_by_attitude(timeline.nodes[interval.first_node + k]);
    if (k == middle) out.to_middle = turned;
    mean_force += weighted;
    out.beside += weighted * turned;
    to_end = turned;
  });
  out.beside -= mean_force * out.to_middle;
  // So far of a value that is held; its mean lies at the middle.
  out.to_middle *= 2.0 * inv_sqrt3;
  out.beside *= 2.0 * inv_sqrt3;
  out.from_middle = 0.5 * sqrt3 * to_end - out.to_middle;
  out.anew = 0.5 * to_end;
  return out;
}

void turn_between_ends(const Interval& interval, const Timeline& timeline, const Vec3& b,
                       Vec3* phi) {
  integrate(interval, timeline, [&](std::size_t k, const Mat3& through) {
    const Node& node = timeline.nodes[interval.first_node + k];
    phi[k] = turned(node, inv_sqrt3 * through * b, phi[k]);
  });
}

}  // namespace drift
