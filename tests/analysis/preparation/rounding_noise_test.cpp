#include "analysis/preparation/rounding_noise.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace drift::preparation::rounding_noise_test {
namespace {

/// A platform that drifts by 0.4 deg a row, its gimbals written to `step` [deg] and in radians of
/// eight decimals, as logs are.
Recording drifting(double step) {
  Recording r;
  Channel outer{"gimbal_outer", unit::rad, {}}, position{"position", unit::one, {}};
  for (int row = 0; row < 200; ++row) {
    const double deg = 90.0 * (row / 50) + 0.4137 * (row % 50);
    outer.values.push_back(std::round(1e8 * step * std::round(deg / step) * detail::deg) * 1e-8);
    position.values.push_back(1.0 + row / 50);
    r.lines.push_back(static_cast<std::size_t>(row + 2));
  }
  r.channels = {position, outer};
  return r;
}

TEST(RoundingNoise, TakesThePlaceOfALessThatIsDeclared) {
  Readout readout;
  std::vector<std::string> remarks;
  take_rounding({drifting(0.1)}, readout, remarks);
  // Uniform over a step: closed form. The texts' last digit is 6e-6 of a step.
  EXPECT_NEAR(readout.gimbal_noise, 0.1 * detail::deg / std::sqrt(12.0), 1e-7 * detail::deg);
  EXPECT_TRUE(readout.gimbals_rounded);
  EXPECT_FALSE(readout.accelerometers_rounded);
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_NE(remarks[0].find("rounding makes a noise of 104 arcsec"), std::string::npos)
      << remarks[0];
}

TEST(RoundingNoise, OfRowsThatReadOneValueIsOneError) {
  Recording r = drifting(0.1);
  std::vector<double>& x = r.channels[1].values;
  for (std::size_t i = 0; i < x.size(); ++i)  // four rows of each value, of a readout that is moved
    x[i] = 0.1 * detail::deg * static_cast<double>(i / 4 + 7 * (i / 50));
  Readout readout;
  std::vector<std::string> remarks;
  take_rounding({r}, readout, remarks);
  // 50 rows are 12 runs of four and one of two: 3.85 on average.
  EXPECT_NEAR(readout.gimbal_noise, 0.1 * detail::deg * std::sqrt(50.0 / 13.0 / 12.0),
              0.02 * detail::deg / std::sqrt(12.0));
}

TEST(RoundingNoise, LeavesWhatIsDeclaredLargerOrWrittenFinely) {
  for (const double step : {0.001, 1e-7}) {
    Readout readout;
    std::vector<std::string> remarks;
    const double declared = readout.gimbal_noise;
    take_rounding({drifting(step)}, readout, remarks);
    EXPECT_EQ(readout.gimbal_noise, declared) << step;
    EXPECT_FALSE(readout.gimbals_rounded);
    EXPECT_TRUE(remarks.empty());
  }
}

}  // namespace
}  // namespace drift::preparation::rounding_noise_test
