#include "core/stats/welch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/core/stats/allan_series.hpp"

namespace drift::stats::welch_test {
namespace {

TEST(Welch, WhiteNoiseHasTwiceItsSquareAtAllFrequencies) {
  Stream random(1, 0, Purpose::test);
  const double interval = 0.01, N = 0.3;
  std::vector<Stretch> two;
  for (const std::size_t length : {20000, 9000})
    two.push_back(test::made_stretch({.white = N / std::sqrt(interval)}, length, random));
  const Spectrum s = welch(two, interval);
  ASSERT_GT(s.segments, 10u);
  EXPECT_NEAR(s.frequency.back(), 50.0, 1e-9);
  // Segments that overlap by half are worth 18/19 of that many independent ones for this window.
  double mean = 0.0;
  for (const double d : s.density) mean += d / static_cast<double>(s.density.size());
  EXPECT_NEAR(mean, 2.0 * N * N, 5.0 * 2.0 * N * N / std::sqrt(29000.0 / 2.0));
  const Spectrum few = thinned(s, 10);
  EXPECT_LT(few.frequency.size(), 50u);
  EXPECT_NEAR(few.density.back(), 2.0 * N * N, 0.1 * 2.0 * N * N);
}

TEST(Welch, ALineStandsAtItsFrequencyWithItsPower) {
  Stretch wave;
  const double interval = 0.005, frequency = 12.5, amplitude = 3.0;  // 64 whole waves a segment
  for (int k = 0; k < 4096; ++k)
    wave.push_back(amplitude * std::sin(2.0 * std::numbers::pi * frequency * interval * k) + 100.0);
  const Spectrum s = welch({&wave, 1}, interval);
  double power = 0.0;
  std::size_t top = 0;
  for (std::size_t k = 0; k < s.density.size(); ++k) {
    power += s.density[k] * s.frequency[0];
    if (s.density[k] > s.density[top]) top = k;
  }
  EXPECT_NEAR(s.frequency[top], frequency, 1e-9);
  EXPECT_NEAR(power, 0.5 * amplitude * amplitude, 1e-9);
  const Stretch brief(20, 1.0);
  EXPECT_TRUE(welch({&brief, 1}, 1.0).frequency.empty());
}

}  // namespace
}  // namespace drift::stats::welch_test
