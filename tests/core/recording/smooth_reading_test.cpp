#include "core/recording/rows/smooth_reading.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "core/recording/rows/parabola.hpp"

namespace drift::smooth_reading_test {
namespace {

using Course = std::function<double(double)>;

/// A temperature of `rows` rows, read in steps; step 0: as it is.
Recording recorded(const Course& course, int rows, double interval, double step) {
  Recording r;
  r.channels = {{"time", unit::s, {}}, {"temperature", "degC"_unit, {}}};
  for (int k = 1; k <= rows; ++k) {
    const double t = interval * k, x = course(t);
    r.channels[0].values.push_back(t);
    r.channels[1].values.push_back(step > 0.0 ? step * std::round(x / step) : x);
  }
  return r;
}

Course swing(double amplitude, double period) {
  return [=](double t) { return 25.0 + amplitude * std::sin(2.0 * std::numbers::pi * t / period); };
}

/// Root mean square by which the rates from row to row are off.
double off(const std::vector<double>& read, const Course& course, const std::vector<double>& t) {
  double sum = 0.0;
  for (std::size_t k = 1; k < t.size(); ++k)
    sum += std::pow(read[k] - read[k - 1] - course(t[k]) + course(t[k - 1]), 2);
  return std::sqrt(sum / static_cast<double>(t.size() - 1));
}

TEST(SmoothReading, ShowsTheRateThatTheStepsHide) {
  const Course course = swing(3.0, 10800.0);
  for (const double step : {0.0625, 0.1, 0.5, 1.0}) {
    const Recording r = recorded(course, 240, 60.0, step);
    const auto smooth = SmoothReading::of(r, "temperature");
    ASSERT_TRUE(smooth) << step;
    EXPECT_NEAR(smooth->step(), step, 1e-9);
    // The error of a parabola through so many rows has an eighth of the variance of one at most,
    // and moves by a part of itself from row to row. What it leaves of the swing is beside that.
    EXPECT_GT(smooth->half(), 10.0 * 60.0) << step;
    EXPECT_LT(std::pow(2.0 * std::numbers::pi * smooth->half() / 10800.0, 4) / 280.0, 0.1) << step;
    const std::vector<double>& t = r.channels[0].values;
    std::vector<double> read;
    for (const double at : t) read.push_back(smooth->at(at).value());
    EXPECT_LT(off(read, course, t), 0.1 * off(r.channels[1].values, course, t)) << step;
  }
}

/// Rows of a second stand at one value for minutes, and are too many to be kept.
TEST(SmoothReading, OfALongLogAndOfOneThatIsReadNowAndThen) {
  const Course course = swing(3.0, 10800.0);
  constexpr double step = 0.0625;
  const Recording seconds = recorded(course, 14400, 1.0, step);
  Recording sparse = recorded(course, 240, 60.0, step);
  for (std::size_t k = 0; k < 240; ++k)
    if (k % 5 != 4) sparse.channels[1].values[k] = nan_value;
  for (const Recording* r : {&seconds, &std::as_const(sparse)}) {
    const auto smooth = SmoothReading::of(*r, "temperature");
    ASSERT_TRUE(smooth);
    double sum = 0.0, rows = 0.0;
    for (double t = 300.0; t <= 14400.0; t += 60.0, rows += 1.0)
      sum += std::pow(smooth->at(t).value() - course(t), 2);
    EXPECT_LT(std::sqrt(sum / rows), step / std::sqrt(12.0)) << "less than a reading is off";
  }
  EXPECT_FALSE(SmoothReading::of(seconds, "temperature")->at(20000.0));
}

TEST(SmoothReading, LeavesAsItIsWhatIsNotHiddenBySteps) {
  const auto left = [](const Course& course, double step) {
    return !SmoothReading::of(recorded(course, 240, 60.0, step), "temperature");
  };
  EXPECT_TRUE(left(swing(3.0, 10800.0), 0.0));
  EXPECT_TRUE(left(swing(3.0, 10800.0), 1e-4)) << "digits that are finer than what it moves by";
  EXPECT_TRUE(left([](double t) { return 20.0 + t / 3600.0; }, 0.0));
  EXPECT_TRUE(left([](double t) { return 20.0 + 0.0625 * t / 60.0; }, 0.0625)) << "a step a row";
  EXPECT_TRUE(left([](double) { return 21.0; }, 0.0));
  // No parabola goes through a jump of 32 steps.
  const Course jump = [](double t) { return swing(3.0, 10800.0)(t) + (t > 7000.0 ? 2.0 : 0.0); };
  EXPECT_TRUE(left(jump, 0.0625));
  EXPECT_FALSE(SmoothReading::of(recorded(jump, 240, 60.0, 0.1), "pressure"));
  EXPECT_FALSE(SmoothReading::of(recorded(swing(3.0, 10800.0), 3, 60.0, 0.1), "temperature"));
}

TEST(Parabola, IsExactForOneAndSaysWhatOfAReadingIsInIt) {
  std::vector<double> t, x;
  for (int k = 0; k < 41; ++k) {
    t.push_back(10.0 * k);
    x.push_back(3.0 - 0.02 * t.back() + 1e-4 * t.back() * t.back());
  }
  const auto middle = parabola_at(t, x, 200.0, 105.0, 4);
  ASSERT_TRUE(middle);
  EXPECT_NEAR(middle->value, x[20], 1e-12);
  // Of n = 2 m + 1 readings: 3 (3 m^2 + 3 m - 1) / ((2 m - 1) (2 m + 1) (2 m + 3)), here m = 10.
  EXPECT_NEAR(middle->part, 3.0 * 329.0 / (19.0 * 21.0 * 23.0), 1e-12);
  EXPECT_FALSE(parabola_at(t, x, 200.0, 15.0, 4));
}

}  // namespace
}  // namespace drift::smooth_reading_test
