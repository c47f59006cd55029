// The mean of what a sensor reads between two instants.
#include <gtest/gtest.h>

#include <cmath>

#include "core/estimate/strapdown/signals.hpp"

namespace drift::strapdown::mean_between_test {
namespace {

const Vec3 c0(0.1, -0.2, 0.3), c1(2.0, 1.0, -3.0), c2(-7.0, 5.0, 4.0), c3(30.0, -20.0, 10.0);

Vec3 polynomial(double t, int degree) {
  return c0 + t * (c1 + (degree > 1 ? t : 0.0) * (c2 + (degree > 2 ? t : 0.0) * c3));
}

Vec3 mean_of(double a, double b, int degree) {  // Simpson's rule, exact up to cubics
  return (polynomial(a, degree) + 4.0 * polynomial(0.5 * (a + b), degree) + polynomial(b, degree)) /
         6.0;
}

Signals read_at(const std::vector<double>& times, int degree) {
  Signals s;
  s.time = times;
  s.interval = 0.1;
  for (const double t : times) {
    s.gyro.push_back(polynomial(t, degree));
    s.acc.push_back(Vec3::UnitZ());
  }
  return s;
}

double error(const Signals& s, std::size_t k, int degree) {
  return (mean_between(s, s.gyro, k) - mean_of(s.time[k - 1], s.time[k], degree)).norm();
}

TEST(MeanBetween, InstantsIsThatOfTheCubicThroughThem) {
  const Signals s = read_at({0.0, 0.1, 0.17, 0.3, 0.5, 0.61}, 3);
  for (std::size_t k = 2; k + 1 < s.size(); ++k) EXPECT_LT(error(s, k, 3), 1e-14) << k;
  EXPECT_GT(error(s, 1, 3), 1e-4);
  const Signals even = read_at({0.0, 0.1, 0.2, 0.3}, 3);
  const std::vector<Vec3>& w = even.gyro;
  const Vec3 weighted = (-w[0] + 13.0 * w[1] + 13.0 * w[2] - w[3]) / 24.0;
  EXPECT_LT((mean_between(even, w, 2) - weighted).norm(), 1e-15);
}

/// Not measured, behind a gap, or at the ends: the parabola; without either neighbour the line.
TEST(MeanBetween, InstantsFallsBackOnTheParabolaAndTheLine) {
  const Signals whole = read_at({0.0, 0.1, 0.21, 0.3, 0.39, 0.5}, 2);
  EXPECT_LT(error(whole, 1, 2), 1e-15);
  EXPECT_LT(error(whole, 5, 2), 1e-15);
  Signals lacks = whole;
  lacks.gyro[4].y() = std::nan("");
  EXPECT_LT(error(lacks, 3, 2), 1e-15);
  lacks.gyro[1].x() = std::nan("");
  EXPECT_EQ(mean_between(lacks, lacks.gyro, 3), 0.5 * (lacks.gyro[2] + lacks.gyro[3]));
  const Signals gaps = read_at({0.0, 0.5, 0.6, 1.1, 1.2, 1.3}, 3);
  EXPECT_EQ(mean_between(gaps, gaps.gyro, 2), 0.5 * (gaps.gyro[1] + gaps.gyro[2]));
  EXPECT_EQ(mean_between(gaps, gaps.gyro, 3), 0.5 * (gaps.gyro[2] + gaps.gyro[3]));
  const Signals after_gap = read_at({0.0, 0.5, 0.6, 0.7}, 2);
  EXPECT_LT(error(after_gap, 2, 2), 1e-15);
}

/// Two samples that follow at once, as a clock of arrival has them: what lies between them over the
/// little time would be noise.
TEST(MeanBetween, InstantsIsNotOfANeighbourMuchNearerThanTheInterval) {
  const Signals s = read_at({0.0, 0.001, 0.1, 0.101}, 3);
  EXPECT_EQ(mean_between(s, s.gyro, 2), 0.5 * (s.gyro[1] + s.gyro[2]));
}

/// A sample's noise is in a turn as often as the trapezoid has it there, but at the ends: the
/// random walk of a turn goes with its length.
TEST(MeanBetween, InstantsCountsEachSampleOfATurnOnce) {
  const std::size_t first = 3, last = 12;
  const double expected[] = {0.0,  0.0,  -1.0, 12.0, 25.0, 24.0, 24.0, 24.0,
                             24.0, 24.0, 24.0, 25.0, 12.0, -1.0, 0.0,  0.0};
  for (std::size_t one = 0; one < 16; ++one) {
    Signals s;
    s.interval = 0.1;
    for (std::size_t k = 0; k < 16; ++k) {
      s.time.push_back(0.1 * static_cast<double>(k));
      s.gyro.push_back(Vec3::Constant(k == one ? 1.0 : 0.0));
      s.acc.push_back(Vec3::UnitZ());
    }
    double sum = 0.0;
    for (std::size_t k = first + 1; k <= last; ++k) sum += mean_between(s, s.gyro, k).x();
    EXPECT_NEAR(24.0 * sum, expected[one], 1e-12) << one;
  }
}

}  // namespace
}  // namespace drift::strapdown::mean_between_test
