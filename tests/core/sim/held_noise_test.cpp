// White noise of the gyros within a sample: against the equations of motion and against its law.
#include "core/sim/held_noise.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/sim/instruments.hpp"
#include "core/sim/platform_ode.hpp"
#include "core/sim/simulate.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::held_noise_test {
namespace {

using namespace drift::test;

/// What an interval does under a constant rate beside the command.
struct Effect {
  Vec3 middle, end;  ///< attitude, chain's inertial axes [rad]
  Vec3 acc;          ///< mean output [g]
};

Effect under(const Timeline& timeline, std::size_t i, const Vec3& omega_noise_p) {
  DriftModel model;
  Simulation sim;
  PlatformOde ode(model, {}, Simulator::default_options(Coupling::eq5));
  Trajectory phi(timeline.nodes.size(), Vec3::Zero());
  const Theta theta = Theta::Zero();
  const Vec3 level = Vec3::Zero();
  const OdeResult result = ode.segment(timeline, i, i + 1, theta, omega_noise_p, &level, phi);
  EXPECT_TRUE(result.ok());
  const Interval& interval = timeline.intervals[i];
  const auto inertial = [&](std::size_t node) -> Vec3 {
    const Node& n = timeline.nodes[node];
    return n.R_il * (n.R_lr * phi[node]);
  };
  const Instruments instruments{&timeline, &model, theta.data()};
  return {inertial(interval.middle_node()), inertial(interval.last_node()),
          instruments.accelerometers(interval, &phi[interval.first_node],
                                     [](std::size_t) { return nullptr; })};
}

/// In a dwell that holds inertial space, and in slews at half a degree a second.
TEST(HeldNoise, IsTheDerivativeOfTheEquationsOfMotion) {
  const Timeline timeline = preset_timeline("slew12", CommandLaw::free, 600.0, 60.0);
  int slews = 0;
  for (std::size_t i = 0; i < timeline.intervals.size() && slews < 3; ++i) {
    const Interval& interval = timeline.intervals[i];
    if (!interval.slew && i > 2) continue;
    slews += interval.slew;
    const HeldNoise held = held_noise(interval, timeline);
    const double T = interval.length(), step = 1e-3 / T;
    Mat3 force = Mat3::Zero();  // mean output by an attitude error that stays
    for (std::size_t k = 0; k < interval.node_count(); ++k) {
      const Node& node = timeline.nodes[interval.first_node + k];
      force += Timeline::mean_weight(interval.substeps, k) * node.R_lr.transpose() *
               skew<double>(Vec3::UnitZ()) * node.R_il.transpose();
    }
    for (int a = 0; a < 3; ++a) {
      const Vec3 n = step * Vec3::Unit(a);
      const Effect plus = under(timeline, i, n), minus = under(timeline, i, -n);
      const Vec3 middle = (plus.middle - minus.middle) / (2.0 * step),
                 end = (plus.end - minus.end) / (2.0 * step),
                 acc = (plus.acc - minus.acc) / (2.0 * step);
      // Of second order in the angle, 1e-3; the rule to the middle of a pair of steps of 0.05 rad.
      const double of_held = 0.5 * std::numbers::sqrt3;  // share of n in a value that is held
      EXPECT_LT((of_held * held.to_middle.col(a) - middle).norm(), 1e-5 * T) << i;
      EXPECT_LT((held.to_middle.col(a) + held.from_middle.col(a) - of_held * end).norm(), 1e-5 * T)
          << i;
      EXPECT_LT((held.anew.col(a) - 0.5 * end).norm(), 1e-5 * T) << i;
      EXPECT_LT((of_held * held.beside.col(a) + force * middle - acc).norm(), 1e-5 * T) << i;
    }
  }
  EXPECT_EQ(slews, 3);
}

/// Of a platform that stands in inertial space, the covariances of a Wiener process with its mean.
TEST(HeldNoise, IsThatOfWhiteNoise) {
  const Timeline timeline = preset_timeline("six", CommandLaw::free, 600.0, 60.0);
  const HeldNoise held = held_noise(timeline.intervals[2], timeline);
  const double T = timeline.intervals[2].length();
  // For q = 1 the values have the variance 1 / T. The platform turns by no more than its drift.
  const Mat3 mean = held.to_middle * held.to_middle.transpose() / T;
  const Mat3 end = held.to_middle + held.from_middle;
  const Mat3 both = held.to_middle * end.transpose() / T;
  const Mat3 at_end = (end * end.transpose() + held.anew * held.anew.transpose()) / T;
  EXPECT_LT((mean - T / 3.0 * Mat3::Identity()).norm(), 1e-9 * T);
  EXPECT_LT((both - T / 2.0 * Mat3::Identity()).norm(), 1e-9 * T);
  EXPECT_LT((at_end - T * Mat3::Identity()).norm(), 1e-9 * T);
}

TEST(HeldNoise, IsNothingAtRestOnTheEarth) {
  Timeline timeline = preset_timeline("six", CommandLaw::free, 600.0);
  Interval rest = timeline.intervals[0];
  rest.rest = true;
  EXPECT_TRUE(held_noise(rest, timeline).to_middle.isZero(0.0));
  EXPECT_FALSE(held_noise(timeline.intervals[0], timeline).to_middle.isZero(0.0));
}

}  // namespace
}  // namespace drift::held_noise_test
