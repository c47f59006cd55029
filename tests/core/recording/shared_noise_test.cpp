// One log at two intervals: rows of which no two are equal, and whose noise is one all the same.
#include "core/recording/rows/shared_noise.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/rng.hpp"

namespace drift::shared_noise_test {
namespace {

constexpr std::size_t dwell = 40, positions = 6;  // rows of each
constexpr const char* names[] = {"acc_x",        "acc_y",         "acc_z",
                                 "gimbal_outer", "gimbal_middle", "gimbal_inner"};

struct Readout {
  double noise = 5e-6, step = 0.0;  ///< [g, rad]; 0: as many digits as there are
  double swing = 0.0;  ///< [g, rad] of both tests, in five rows, and what settles in each position
};

/// A test of one unit, a row each 30 s, whose course is the same in each, with noise of its own.
Recording log_of(std::uint64_t seed, Readout made = {}) {
  Stream stream(seed, 0, Purpose::test);
  Recording r;
  r.channels = {{"time", unit::s, {}}, {"position", unit::one, {}}, {"phase", unit::one, {}}};
  for (const char* name : names) r.channels.push_back({name, unit::one, {}});
  for (std::size_t row = 0; row < positions * dwell; ++row) {
    const auto number = static_cast<double>(row / dwell), after = static_cast<double>(row % dwell);
    r.channels[0].values.push_back(30.0 * static_cast<double>(row + 1));
    r.channels[1].values.push_back(number + 1.0);
    r.channels[2].values.push_back(0.0);
    for (std::size_t c = 0; c < 6; ++c) {
      const double turned = 2e-3 * after + static_cast<double>(c) - number;
      const double alike =
          made.swing * (std::sin(1.2566 * static_cast<double>(row)) + 10.0 * std::exp(-after));
      const double x = std::sin(turned) + alike + made.noise * stream.normal();
      r.channels[3 + c].values.push_back(made.step > 0.0 ? made.step * std::round(x / made.step)
                                                         : x);
    }
    r.lines.push_back(row + 2);
  }
  return r;
}

enum class Kept { every_other_row, means_of_two };

/// The log at twice the interval; angles are read at the end.
Recording coarser(const Recording& log, Kept kept) {
  Recording r;
  for (const Channel& c : log.channels) {
    r.channels.push_back({c.name, c.unit, {}});
    const bool mean = kept == Kept::means_of_two && c.name.starts_with("acc_");
    for (std::size_t row = 1; row < log.rows(); row += 2)
      r.channels.back().values.push_back(mean ? 0.5 * (c.values[row - 1] + c.values[row])
                                              : c.values[row]);
  }
  for (std::size_t row = 0; row < r.rows(); ++row) r.lines.push_back(row + 2);
  return r;
}

Recording accelerometers_alone(Recording r) {
  r.channels.resize(6);
  return r;
}

void expect_one_log(const Recording& a, const Recording& b, double least, double most) {
  for (const auto& found : {shared_noise(a, b), shared_noise(b, a)}) {
    ASSERT_TRUE(found);
    EXPECT_GE(found->alike, least);
    EXPECT_LE(found->alike, most);
    EXPECT_GT(found->readings, 120u);
  }
}

TEST(SharedNoise, MeansAndEveryOtherRowAreTheLogThatTheyAreMadeOf) {
  const Recording log = log_of(1);
  expect_one_log(log, coarser(log, Kept::means_of_two), 0.99, 1.0);
  expect_one_log(log, coarser(log, Kept::every_other_row), 0.99, 1.0);
}

TEST(SharedNoise, MeansAndEveryOtherRowOfOneLogHaveHalfOfTheirNoiseInCommon) {
  const Recording log = accelerometers_alone(log_of(1));
  expect_one_log(coarser(log, Kept::every_other_row), coarser(log, Kept::means_of_two), 0.7, 0.95);
}

TEST(SharedNoise, AnotherClockAnotherScaleAndAnotherZeroHideNothing) {
  const Recording log = log_of(1);
  Recording other = coarser(log, Kept::means_of_two);
  for (double& t : other.channels[0].values) t -= 60.0;  // begins with its own first row
  for (double& x : other.channels[3].values) x = 1.0003 * x + 4e-4;
  expect_one_log(log, other, 0.95, 1.0);
}

TEST(SharedNoise, TestsOfOneUnitHaveNone) {
  // Expected are fewer than 200 * 1e-4 = 0.02.
  Stream stream(3, 0, Purpose::test);
  for (std::uint64_t k = 0; k < 200; ++k) {
    const double noise = 1e-8 * std::pow(10.0, 4.0 * stream.uniform());
    const Readout made{noise, k % 2 == 0 ? 0.0 : noise * (0.2 + 4.0 * stream.uniform())};
    const Recording a = log_of(2 * k, made), b = log_of(2 * k + 1, made);
    EXPECT_FALSE(shared_noise(a, k % 4 < 2 ? b : coarser(b, Kept::means_of_two)))
        << "noise " << noise << ", step " << made.step;
  }
}

TEST(SharedNoise, WhatSwingsAndSettlesAlikeInBothIsNoNoise) {
  for (const double noise : {1e-7, 5e-6})
    for (std::uint64_t k = 0; k < 20; ++k) {
      const Readout made{.noise = noise, .swing = 5e-5};
      EXPECT_FALSE(shared_noise(log_of(2 * k, made), log_of(2 * k + 1, made))) << noise;
    }
}

TEST(SharedNoise, WithoutNoiseNothingIsSaid) {
  const Recording still = log_of(1, {.noise = 0.0}), counts = log_of(1, {0.0, 61e-6});
  EXPECT_FALSE(shared_noise(still, coarser(still, Kept::means_of_two)));
  EXPECT_FALSE(shared_noise(counts, coarser(counts, Kept::every_other_row)));
}

TEST(SharedNoise, WhatHasNoPositionsIsNotComparedByThem) {
  Recording log = log_of(1);
  log.channels[1].name = "count";
  EXPECT_FALSE(shared_noise(log, coarser(log, Kept::means_of_two)));
  EXPECT_FALSE(shared_noise(Recording{}, Recording{}));
}

}  // namespace
}  // namespace drift::shared_noise_test
