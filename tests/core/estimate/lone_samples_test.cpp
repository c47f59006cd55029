// Samples of a gyro that no motion makes.
#include "core/estimate/strapdown/lone_samples.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/nan.hpp"
#include "core/base/normal_draws.hpp"
#include "core/stats/small_samples.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::lone_samples_test {
namespace {

using strapdown::LoneSample;
using strapdown::Signals;
constexpr double interval = 0.01, noise = 0.05 * detail::deg;

/// 20 s at 100 Hz: at rest, a turn of 90 deg that starts and stops with a jerk, a table's rate that
/// jumps, a knock that rings at 25 Hz.
Signals hand_and_table(std::uint64_t seed) {
  Signals s;
  s.interval = interval;
  Stream stream(seed, 0, Purpose::test);
  for (int k = 0; k < 2000; ++k) {
    const double t = interval * (k + 1);
    Vec3 w = Vec3::Zero();
    if (t > 4.0 && t < 6.0) w.x() = 0.5 * std::numbers::pi * (1.0 - std::cos(std::numbers::pi * t));
    if (t > 8.0 && t < 10.0) w.y() = 0.2;
    if (t > 12.0) w.z() = 0.5 * std::exp(-20.0 * (t - 12.0)) * std::sin(157.0 * (t - 12.0));
    for (int a = 0; a < 3; ++a) w[a] += noise * stream.normal();
    s.time.push_back(t);
    s.gyro.push_back(w);
    s.acc.emplace_back(0.0, 0.0, 1.0);
  }
  return s;
}

TEST(LoneSamples, NothingIsFoundInMotionJumpsOfRateAndKnocks) {
  // A sample by chance: 1e-3 a recording, two in fifty have 1e-3.
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed)
    found += static_cast<int>(lone_gyro_samples(hand_and_table(seed)).size());
  EXPECT_LE(found, 1);
}

TEST(LoneSamples, OneThatIsOffIsFoundWithItsSize) {
  for (const std::size_t k : {100ul, 500ul, 890ul, 1500ul}) {  // rest, turn, table, after the knock
    SCOPED_TRACE(k);
    Signals s = hand_and_table(7);
    constexpr double off = 5.0 * detail::deg;
    s.gyro[k].y() += off;
    const auto all = lone_gyro_samples(s);
    ASSERT_EQ(all.size(), 1u);
    EXPECT_EQ(all[0].sample, k);
    EXPECT_EQ(all[0].axis, 1);
    // Of white noise: sigma sqrt(2.63 / 1.94).
    EXPECT_NEAR(all[0].off, off, 5.0 * noise);
    EXPECT_DOUBLE_EQ(all[0].turns, all[0].off * interval);
  }
}

TEST(LoneSamples, TwoTogetherOneBesideAGapAndOneStepOfTheReadoutAreNotSaid) {
  Signals two = hand_and_table(7);
  for (const std::size_t k : {100ul, 101ul}) two.gyro[k].y() += 0.1;
  EXPECT_TRUE(lone_gyro_samples(two).empty());
  Signals gap = hand_and_table(7);
  gap.gyro[100].y() += 0.1;
  gap.gyro[98].y() = nan_value;
  EXPECT_TRUE(lone_gyro_samples(gap).empty());
  Signals steps = hand_and_table(7);
  for (Vec3& w : steps.gyro) w.setZero();
  steps.gyro[100].y() = 0.01;
  EXPECT_TRUE(lone_gyro_samples(steps).empty());
}

TEST(LoneSamples, OneIsFoundWhereNoiseIsBelowTheStepOfTheReadout) {
  Signals s = hand_and_table(7);
  for (std::size_t k = 0; k < s.size(); ++k)
    s.gyro[k] = Vec3(k % 500 == 250 ? 0.001 : 0.0, 0.0, 0.0);
  s.gyro[100].x() = 0.05;
  const auto all = lone_gyro_samples(s);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].sample, 100u);
  EXPECT_NEAR(all[0].off, 0.05, 1e-12);
}

}  // namespace
}  // namespace drift::lone_samples_test
