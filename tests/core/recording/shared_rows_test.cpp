// Rows that stand in two recordings: evidence that would count twice.
#include "core/recording/rows/shared_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/rng.hpp"

namespace drift::shared_rows_test {
namespace {

constexpr std::size_t dwell = 20, positions = 6;  // rows of each

struct Readout {
  double noise = 5e-6, step = 0.0;  // [g]; 0: as many digits as there are
};

/// A test of one unit, whose course is the same in each, with noise of its own.
Recording test_of(std::uint64_t seed, Readout made = {}) {
  Stream stream(seed, 0, Purpose::test);
  Recording r;
  r.channels = {{"time", unit::s, {}},           {"position", unit::one, {}},
                {"phase", unit::one, {}},        {"acc_x", *parse_unit("g"), {}},
                {"acc_y", *parse_unit("g"), {}}, {"acc_z", *parse_unit("g"), {}}};
  for (std::size_t row = 0; row < positions * dwell; ++row) {
    const auto number = static_cast<double>(row / dwell), after = static_cast<double>(row % dwell);
    r.channels[0].values.push_back(60.0 * static_cast<double>(row + 1));
    r.channels[1].values.push_back(number + 1.0);
    r.channels[2].values.push_back(0.0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double up = row / dwell % 3 == axis ? 1.0 : 0.0;
      const double x = up + 3e-4 * after * (static_cast<double>(axis) - number) * (1.0 - up) +
                       made.noise * stream.normal();
      r.channels[3 + axis].values.push_back(made.step > 0.0 ? made.step * std::round(x / made.step)
                                                            : x);
    }
    r.lines.push_back(row + 2);
  }
  return r;
}

/// Rows `from` to `to` of a recording.
Recording part_of(Recording r, std::size_t from, std::size_t to) {
  const auto cut = [&](auto& values) {
    values.erase(values.begin() + static_cast<std::ptrdiff_t>(to), values.end());
    values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(from));
  };
  for (Channel& c : r.channels) cut(c.values);
  cut(r.lines);
  return r;
}

void expect_shared(const Recording& a, const Recording& b, SharedRows expected) {
  const auto found = shared_rows(a, b);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->first, expected.first);
  EXPECT_EQ(found->second, expected.second);
  EXPECT_EQ(found->count, expected.count);
}

TEST(SharedRows, ACopyThatLacksRowsIsFoundWhateverTheOrder) {
  const Recording whole = test_of(1);
  expect_shared(whole, part_of(whole, 0, 119), {0, 0, 119});
  expect_shared(part_of(whole, 0, 119), whole, {0, 0, 119});
  expect_shared(whole, part_of(whole, 40, 80), {40, 0, 40});
  expect_shared(part_of(whole, 40, 80), whole, {0, 40, 40});
}

TEST(SharedRows, OneLogThatWasCutTwiceIsFoundByItsOverlap) {
  const Recording log = test_of(1);
  expect_shared(part_of(log, 0, 70), part_of(log, 55, 120), {55, 0, 15});
}

TEST(SharedRows, OtherDigitsAndUnitsHideNoCopy) {
  Recording whole = test_of(1), copy = part_of(whole, 30, 110);
  for (std::size_t axis = 3; axis < 6; ++axis) {
    for (double& x : copy.channels[axis].values) x = 1e-6 * std::round(1e6 * x);
    whole.channels[axis].values[50] = copy.channels[axis].values[20] = NAN;  // in both
  }
  expect_shared(whole, copy, {30, 0, 80});
}

TEST(SharedRows, AngleReadingsTellWhereThereAreNoAccelerometers) {
  Recording whole = test_of(1);
  const char* names[] = {"gimbal_outer", "gimbal_middle", "gimbal_inner"};
  for (std::size_t axis = 0; axis < 3; ++axis) whole.channels[3 + axis].name = names[axis];
  expect_shared(whole, part_of(whole, 0, 60), {0, 0, 60});
}

TEST(SharedRows, TestsOfOneUnitShareNone) {
  // Expected are fewer than 400 * 1e-4 = 0.04: one in 400 would have a chance of 4 %.
  Stream stream(3, 0, Purpose::test);
  for (std::uint64_t k = 0; k < 400; ++k) {
    const double noise = 1e-8 * std::pow(10.0, 4.0 * stream.uniform());
    const Readout made{noise, k % 2 == 0 ? 0.0 : noise * (0.2 + 4.0 * stream.uniform())};
    EXPECT_FALSE(shared_rows(test_of(2 * k, made), test_of(2 * k + 1, made)))
        << "noise " << noise << ", step " << made.step;
  }
}

TEST(SharedRows, WhatIsAlikeWithoutNoiseIsNoCopy) {
  const Recording still = test_of(1, {.noise = 0.0});
  EXPECT_FALSE(shared_rows(still, part_of(still, 0, 110)));
  const Recording counts = test_of(1, {.noise = 0.0, .step = 61e-6});
  EXPECT_FALSE(shared_rows(counts, part_of(counts, 0, 110)));
  Recording a = test_of(1), b = test_of(2);  // one channel is dead in both, one is absent
  for (Recording* r : {&a, &b}) {
    r->channels[3].values.assign(positions * dwell, 0.0);
    r->channels.erase(r->channels.begin() + 4);
  }
  EXPECT_FALSE(shared_rows(a, b));
  expect_shared(a, part_of(a, 10, 120), {10, 0, 110});
}

}  // namespace
}  // namespace drift::shared_rows_test
