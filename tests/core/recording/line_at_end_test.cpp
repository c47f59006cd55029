#include "core/recording/rows/line_at_end.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/nan.hpp"
#include "core/base/rng.hpp"

namespace drift::line_at_end_test {
namespace {

std::vector<double> seconds(int count) {
  std::vector<double> t;
  for (int k = 1; k <= count; ++k) t.push_back(k);
  return t;
}

TEST(LineAtEnd, IsWhatIsReadThereToTheFirstOrder) {
  const std::vector<double> t = seconds(40);
  std::vector<double> ramp, square;
  for (const double at : t) {
    ramp.push_back(20.0 + 0.01 * at);
    square.push_back(at * at);
  }
  EXPECT_NEAR(line_at_end(t, ramp, {0, 40}), 20.4, 1e-13);
  EXPECT_NEAR(line_at_end(t, ramp, {10, 20}), 20.2, 1e-13);
  // Of n readings 1 s apart the line misses a square by (n - 1)(n - 2) / 6 at its end.
  EXPECT_NEAR(line_at_end(t, square, {10, 20}), 400.0 - 9.0 * 8.0 / 6.0, 1e-9);
  // Where the end is not read, the line goes on, but no farther out than was read.
  ramp[19] = nan_value;
  EXPECT_EQ(line_at_end(t, ramp, {10, 20}), ramp[18]);
  ramp[12] = nan_value;
  EXPECT_NEAR(line_at_end(t, ramp, {10, 19}), 20.19, 1e-13);
}

TEST(LineAtEnd, IsTheReadingWhereThatIsOneOrAllAreEqual) {
  const std::vector<double> t = seconds(10);
  const std::vector<double> equal(10, 21.3), one{7.1, nan_value};
  EXPECT_EQ(line_at_end(t, equal, {0, 10}), 21.3);
  EXPECT_EQ(line_at_end(t, one, {0, 1}), 7.1);
  EXPECT_EQ(line_at_end(t, one, {0, 2}), 7.1);
  const std::vector<double> few{1.0, nan_value, nan_value}, none(3, nan_value);
  EXPECT_TRUE(std::isnan(line_at_end(t, few, {0, 3})));
  EXPECT_TRUE(std::isnan(line_at_end(t, none, {0, 3})));
  EXPECT_TRUE(std::isnan(line_at_end(t, none, {0, 1})));
}

TEST(LineAtEnd, OfWhatJumpsStaysWithinWhatWasRead) {
  const std::vector<double> t = seconds(10), valve{0, 0, 0, 0, 0, 1, 1, 1, 1, 1},
                            shut{5, 5, 5, 5, 5, 0, 0, 0, 0, 0};
  EXPECT_EQ(line_at_end(t, valve, {0, 10}), 1.0);
  EXPECT_EQ(line_at_end(t, shut, {0, 10}), 0.0);  // a root of it is no error
}

TEST(LineAtEnd, AveragesNoise) {
  constexpr int draws = 2000, readings = 30;
  const std::vector<double> t = seconds(readings);
  Stream random(1, 0, Purpose::test);
  double squares = 0.0;
  for (int k = 0; k < draws; ++k) {
    std::vector<double> x;
    for (int i = 0; i < readings; ++i) x.push_back(20.0 + random.normal());
    squares += std::pow(line_at_end(t, x, {0, readings}) - 20.0, 2);
  }
  // A line by least squares has (4 n - 2) / (n (n + 1)) of the variance at its last reading; the
  // root of a mean of so many squares has 1 / sqrt(2 draws) of itself as sigma.
  const double sigma = std::sqrt((4.0 * readings - 2.0) / (readings * (readings + 1.0)));
  EXPECT_NEAR(std::sqrt(squares / draws), sigma, 4.0 * sigma / std::sqrt(2.0 * draws));
}

}  // namespace
}  // namespace drift::line_at_end_test
