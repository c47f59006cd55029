#include "core/recording/rows/bridged_mean.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace drift::bridged_mean_test {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Rows of a minute, a second each: means of a sine that turns by `angle` in it.
struct Minute {
  std::vector<double> begins, ends, values;
  double mean = 0.0;

  explicit Minute(double angle) {
    const auto integral = [&](double t) {
      return -60.0 / angle * std::cos(0.4 + angle * t / 60.0);
    };
    for (int k = 0; k < 60; ++k) {
      begins.push_back(k);
      ends.push_back(k + 1.0);
      values.push_back(integral(k + 1.0) - integral(k));
    }
    mean = (integral(60.0) - integral(0.0)) / 60.0;
  }
  BridgedMean bridged(double angle) const {
    return bridged_mean(begins, ends, values, {0, values.size()}, angle);
  }
};

TEST(BridgedMean, IsTheMeanWeightedByTimeWhereNothingIsMissing) {
  const BridgedMean m =
      bridged_mean({0.0, 1.0, 4.0}, {1.0, 4.0, 5.0}, {2.0, 3.0, 7.0}, {0, 3}, 9.0);
  EXPECT_DOUBLE_EQ(m.value, (2.0 + 3.0 * 3.0 + 7.0) / 5.0);
  EXPECT_DOUBLE_EQ(m.seconds, 5.0);
}

TEST(BridgedMean, HolesAreBridgedToTwoMicroGInADwellAndInASlew) {
  for (const double angle : {0.0044, 0.05, 0.5}) {
    Minute minute(angle);
    for (const std::size_t lost : {3, 4, 5, 17, 30, 31, 44, 58, 59}) minute.values[lost] = none;
    const BridgedMean m = minute.bridged(angle);
    EXPECT_NEAR(m.value, minute.mean, 2e-6) << angle;
    EXPECT_GT(m.seconds, 40.0) << angle;
    EXPECT_LE(m.seconds, 51.0) << angle;  // no more than what was measured
  }
}

TEST(BridgedMean, IsNotMeasuredWhereTooLittleIs) {
  Minute half(0.0044), long_turn(2.0);
  for (std::size_t k = 0; k < 31; ++k) half.values[k] = none;
  EXPECT_TRUE(std::isnan(half.bridged(0.0044).value));
  long_turn.values[10] = none;
  EXPECT_TRUE(std::isnan(long_turn.bridged(2.0).value))
      << "no polynomial of degree four follows it";
  EXPECT_TRUE(std::isnan(bridged_mean({0.0}, {1.0}, {none}, {0, 1}, 0.001).value));
}

TEST(BridgedMean, SaysWhatItsNoiseIsWorth) {
  // Half of the rows, at one end: the straight line reaches far and the noise grows.
  Minute minute(0.0044);
  const double all = minute.bridged(0.0044).seconds;
  for (std::size_t k = 40; k < 60; ++k) minute.values[k] = none;
  const double reaching = minute.bridged(0.0044).seconds;
  EXPECT_DOUBLE_EQ(all, 60.0);
  // Line through 40 s, taken 10 s off its middle: variance (1 + 12 (10/40)^2) / 40.
  EXPECT_NEAR(reaching, 40.0 / 1.75, 0.05);
}

}  // namespace
}  // namespace drift::bridged_mean_test
