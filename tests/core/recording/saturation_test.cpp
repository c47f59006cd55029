// A sensor at the end of its range reads one value; noise does not.
#include "core/recording/saturation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/rng.hpp"
#include "core/recording/rows/quality_card.hpp"

namespace drift::saturation_test {
namespace {

constexpr double fastest = 3.0;  // [rad/s]

/// A gyro that rests for four seconds and turns for two, twelve times, at 100 Hz; the fastest rate
/// differs from turn to turn.
Recording gyro(std::uint64_t seed, double noise) {
  Recording r;
  r.channels = {{"time", unit::s, {}}, {"gyro_x", *parse_unit("rad/s"), {}}};
  Stream random(seed, 0, Purpose::test);
  for (int row = 0; row < 7200; ++row) {
    const int turn = row / 600, within = row % 600 - 400;
    const double size = (turn % 2 == 0 ? 1.0 : -1.0) * fastest * (1.0 - 0.05 * turn);
    const double rate =
        within < 0 ? 0.0 : 0.5 * size * (1.0 - std::cos(2.0 * std::numbers::pi * within / 200.0));
    r.channels[0].values.push_back(0.01 * row);
    r.channels[1].values.push_back(0.02 + rate + noise * random.normal());
    r.lines.push_back(static_cast<std::size_t>(row) + 2);
  }
  return r;
}

std::vector<double>& values(Recording& r) {
  return r.channels[1].values;
}

void clip(Recording& r, double low, double high) {
  for (double& v : values(r)) v = std::clamp(v, low, high);
}

void round_to(Recording& r, double step) {
  for (double& v : values(r)) v = step * std::round(v / step);
}

std::size_t beyond(const Recording& r, double limit) {
  return static_cast<std::size_t>(
      std::ranges::count_if(r.channels[1].values, [&](double v) { return v >= limit; }));
}

TEST(Saturation, BothEndsOfARangeAreFoundWithAllTheirRows) {
  Recording r = gyro(1, 2e-3);
  const std::size_t cut = beyond(r, 2.5);
  ASSERT_GT(cut, 20u);
  clip(r, -2.3, 2.5);
  const auto found = saturated_gyros(r);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].at, Saturation::At::low);
  EXPECT_EQ(found[0].value, -2.3);
  EXPECT_EQ(found[1].at, Saturation::At::high);
  EXPECT_EQ(found[1].rows.size(), cut);
  // Turns 0 and 2 pass 2.5 rad/s (3.0 and 2.7); noise breaks a run where the rate crosses it.
  EXPECT_GE(found[1].runs(), 2u);
  const QualityCard card = quality_card(r, RecordingKind::strapdown);
  EXPECT_EQ(card.channels[0].saturated(), found[0].runs() + found[1].runs());
  EXPECT_NE(card.remarks.first_wrong().find("gyro_x: "), std::string::npos);
  EXPECT_NE(card.remarks.first_wrong().find("read -2.3 rad/s, its least"), std::string::npos)
      << card.remarks.first_wrong();
}

TEST(Saturation, SixRowsOfOneTurnAreEnough) {
  Recording r = gyro(2, 2e-3);
  round_to(r, 2e-4);  // a tenth of the noise: one value comes back with 0.04
  auto& x = values(r);
  const auto top = static_cast<std::size_t>(std::ranges::max_element(x) - x.begin());
  double limit = 0.0;
  for (std::size_t k = top - 3; k < top + 3; ++k) limit = std::max(limit, x[k]);
  for (std::size_t k = top - 3; k < top + 3; ++k) x[k] = limit;
  const auto found = saturated_gyros(r);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].rows.size(), 6u);
}

TEST(Saturation, ARunInATurnBelowOthersIsFoundAndOneAtRestIsNone) {
  Recording r = gyro(3, 2e-3);
  auto& x = values(r);
  for (std::size_t k = 600 + 460; k < 600 + 466; ++k) x[k] = x[600 + 460];
  auto found = saturated_gyros(r);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].at, Saturation::At::between);
  EXPECT_EQ(found[0].rows.front(), 1060u);
  Recording rest = gyro(3, 2e-3);
  for (std::size_t k = 600; k < 606; ++k) values(rest)[k] = values(rest)[600];
  EXPECT_TRUE(saturated_gyros(rest).empty());
}

TEST(Saturation, NoiseFindsNoneWhateverTheStepOfTheReadout) {
  // Chance finds one in a thousand recordings: here 120 have one with 0.12 at most.
  std::size_t found = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    for (const double step : {0.0, 2e-4, 1e-3, 2e-3, 4e-3, 0.02}) {
      Recording r = gyro(100 + seed, 2e-3);
      if (step > 0.0) round_to(r, step);
      found += saturated_gyros(r).size();
    }
  EXPECT_LE(found, 1u);
}

TEST(Saturation, ATableThatTurnsAtOneRateIsNotAtItsEnd) {
  // Turns at 1 rad/s for two seconds: noise of half a step, a fifth of one, and ten steps.
  for (const double noise : {1e-3, 4e-4, 2e-2}) {
    Recording r = gyro(4, noise);
    Stream random(5, 0, Purpose::test);
    for (std::size_t row = 0; row < r.rows(); ++row)
      if (row % 600 >= 400) values(r)[row] = 1.0 + noise * random.normal();
    round_to(r, 2e-3);
    EXPECT_TRUE(saturated_gyros(r).empty()) << noise;
  }
}

TEST(Saturation, ALogThatIsFasterThanItsSensorRepeatsItselfEverywhere) {
  Recording r = gyro(6, 2e-3);
  for (std::size_t row = 1; row < r.rows(); ++row)
    if (row % 4 != 0) values(r)[row] = values(r)[row - 1];
  EXPECT_TRUE(saturated_gyros(r).empty());
}

}  // namespace
}  // namespace drift::saturation_test
