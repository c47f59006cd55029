#include "core/estimate/strapdown/turn_reading.hpp"

#include <gtest/gtest.h>

namespace drift::strapdown::turn_reading_test {
namespace {

/// A row in which the rate changes reads as an even turn does; the acceleration is the change of
/// the rate over the row.
TEST(TurnReading, IsThatOfAnEvenTurn) {
  constexpr double dt = 0.002, length = 0.4, gravity = 9.8;
  const Vec3 axis = Vec3(1.0, -2.0, 0.5).normalized(), f0(0.6, 0.0, 0.8);
  Signals s;
  s.interval = dt;
  for (int k = 0; k <= 200; ++k) {
    const double t = dt * k, angle = 0.5 * t * t;  // 1 rad/s^2 from rest
    s.time.push_back(t);
    s.gyro.push_back(t * axis);
    s.acc.push_back(rotation(Vec3(-angle * axis)) * f0);
  }
  const TurnReading read = turn_reading(s, 0, 200, f0, gravity);
  const double whole = 0.5 * length * length;
  Vec3 even = Vec3::Zero();
  constexpr int steps = 1000;
  for (int k = 0; k < steps; ++k)
    even += rotation(Vec3(-whole * (k + 0.5) / steps * axis)) * f0 / steps;
  EXPECT_LT((read.acc - even).norm(), 2e-7);
  EXPECT_GT((s.acc[100] - even).norm(), 1e-2);  // what the correction is of
  EXPECT_LT((read.turn.rate - 0.5 * length * axis).norm(), 1e-12);
  const Mat3 expected = (skew(axis) + length * length / 3.0 * skew(axis) * skew(axis)) / gravity;
  EXPECT_LT((read.turn.arm - expected).norm(), 1e-5);
}

}  // namespace
}  // namespace drift::strapdown::turn_reading_test
