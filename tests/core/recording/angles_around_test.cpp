#include "core/recording/rows/angles_around.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace drift::angles_around_test {
namespace {

std::vector<double> sampled(auto&& f, int rows = 61) {
  std::vector<double> x;
  for (int k = 0; k < rows; ++k) x.push_back(f(static_cast<double>(k)));
  return x;
}

TEST(AnglesAround, AreThoseOfAParabolaAndOfACubic) {
  const AnglesAround around(20, 1, 1.0);
  const auto noise = [](double t) { return 1e-3 * std::cos(2.7 * t * t); };
  const auto more = [&](auto&& f) {  // what f makes of it: the result is linear in the readings
    return around.at(sampled([&](double t) { return noise(t) + f(t); }), 30) -
           around.at(sampled(noise), 30);
  };
  const auto f = [](double t) { return 0.3 - 2e-3 * t + 4e-5 * t * t + 1e-6 * t * t * t; };
  EXPECT_NEAR(more(f), f(30.0), 1e-13);
  // Of a fourth power t^4 / 24 what Legendre's polynomials make of it: T^4 / 4480, here of 19
  // samples.
  const double off = more([](double t) { return std::pow(t - 30.0, 4) / 24e6; });
  EXPECT_NEAR(std::abs(off) * 1e6, std::pow(19.0, 4) / 4480.0, 0.05 * std::pow(19.0, 4) / 4480.0);
}

TEST(AnglesAround, AreWorthAsManyReadingsAsTheirWeightsSay) {
  for (const std::size_t factor : {5u, 6u, 12u, 60u}) {
    const AnglesAround around(factor, 1, 1.0);
    ASSERT_TRUE(around.fits());
    // The noise of the result: the sum of squares of what a unit in each reading does to it.
    double variance = 0.0;
    for (int k = 0; k < 121; ++k) {
      std::vector<double> x = sampled([](double t) { return 1e-3 * std::cos(2.7 * t * t); }, 121);
      const double before = around.at(x, 60);
      x[static_cast<std::size_t>(k)] += 1e-4;
      variance += std::pow((around.at(x, 60) - before) / 1e-4, 2);
    }
    EXPECT_NEAR(1.0 / variance, around.readings(), 1e-6 * around.readings()) << factor;
    EXPECT_LT(around.readings(), static_cast<double>(factor));
  }
  EXPECT_FALSE(AnglesAround(4, 1, 1.0).fits());
}

TEST(AnglesAround, GoAcrossAWholeTurnAndStopAtWhatIsIsolated) {
  const AnglesAround around(12, 1, 1.0);
  const auto wrapped = [](double t) {
    return std::remainder(std::numbers::pi + 1e-3 * (t - 30.2), 2.0 * std::numbers::pi) +
           1e-6 * std::cos(2.7 * t * t);
  };
  std::vector<double> x = sampled(wrapped);
  EXPECT_NEAR(std::remainder(around.at(x, 30) - wrapped(30.0), 2.0 * std::numbers::pi), 0.0, 2e-6);
  x[27] += 1e-4;
  EXPECT_TRUE(std::isnan(around.at(x, 30)));
  x[27] = std::nan("");
  EXPECT_TRUE(std::isnan(around.at(x, 30)));
}

TEST(AnglesAround, TakeEveryReadingThatIsOne) {
  const AnglesAround every(12, 3, 1.0), plain(12, 1, 3.0);
  const auto f = [](double t) { return 1e-3 * std::cos(2.7 * t * t); };
  std::vector<double> x = sampled(f), thirds;
  for (std::size_t k = 0; k < x.size(); k += 3) thirds.push_back(x[k]);
  EXPECT_EQ(every.at(x, 30), plain.at(thirds, 10));
  EXPECT_EQ(every.readings(), plain.readings());
}

TEST(AnglesAround, NeedRowsOfOneStretchEvenlySpaced) {
  const AnglesAround around(11, 1, 2.0);
  std::vector<double> t = sampled([](double k) { return 2.0 * k; });
  EXPECT_TRUE(around.around(30, 0, 60, t));
  EXPECT_TRUE(around.around(30, 25, 35, t));
  EXPECT_FALSE(around.around(30, 26, 60, t));
  EXPECT_FALSE(around.around(30, 0, 34, t));
  for (std::size_t k = 32; k < t.size(); ++k) t[k] += 2.0;  // a row is lost
  EXPECT_FALSE(around.around(30, 0, 60, t));
}

}  // namespace
}  // namespace drift::angles_around_test
