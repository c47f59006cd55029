#include "analysis/preparation/rounding_noise.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace drift::preparation::rounding_noise_test {
namespace {

/// A platform that drifts by 0.425 deg a row, its gimbals written to `step` [deg] and in radians of
/// eight decimals, as logs are.
Recording drifting(double step) {
  Recording r;
  Channel outer{"gimbal_outer", unit::rad, {}}, position{"position", unit::one, {}};
  for (int row = 0; row < 200; ++row) {
    const double deg = 90.0 * (row / 50) + 0.425 * (row % 50);
    outer.values.push_back(std::round(1e8 * step * std::round(deg / step) * detail::deg) * 1e-8);
    position.values.push_back(1.0 + row / 50);
    r.lines.push_back(static_cast<std::size_t>(row + 2));
  }
  r.channels = {position, outer};
  return r;
}

TEST(RoundingNoise, IsAddedToALessThatIsDeclared) {
  Readout readout;
  const double declared = readout.gimbal_noise;
  std::vector<std::string> remarks;
  take_rounding(rounding_of({drifting(0.1)}), readout, remarks);
  // Uniform over a step, and by 4, 4, 4, 5 steps a row: an error comes back every fourth row.
  const double rounding = 0.1 * detail::deg * std::sqrt(4.0 / 12.0);
  EXPECT_NEAR(readout.gimbal_noise, std::hypot(rounding, declared), 0.05 * rounding);
  EXPECT_TRUE(readout.gimbals_rounded);
  EXPECT_FALSE(readout.accelerometers_rounded);
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_NE(remarks[0].find("gimbal_outer is written in steps of 0.00175 rad: with the noise of "
                            "rounding it is "),
            std::string::npos)
      << remarks[0];
}

TEST(RoundingNoise, OfRowsThatReadOneValueIsOneError) {
  Recording r = drifting(0.1);
  std::vector<double>& x = r.channels[1].values;
  for (std::size_t i = 0; i < x.size(); ++i)  // five rows of each value
    x[i] = 0.1 * detail::deg * static_cast<double>(i / 5 + 7 * (i / 50));
  const Rounding found = rounding_of({r});
  EXPECT_NEAR(found.gimbals.noise, 0.1 * detail::deg * std::sqrt(5.0 / 12.0), 1e-9);
}

TEST(RoundingNoise, OfOneOfTwoRecordingsIsSaidOfThatFile) {
  Recording coarse = drifting(0.1), fine = drifting(1e-7);
  coarse.source = "coarse.csv";
  fine.source = "fine.csv";
  for (const auto& both : {std::vector{coarse, fine}, std::vector{fine, coarse}}) {
    Readout readout;
    std::vector<std::string> remarks;
    take_rounding(rounding_of(both), readout, remarks);
    ASSERT_EQ(remarks.size(), 1u);
    EXPECT_EQ(remarks[0].find("coarse.csv: "), 0u) << remarks[0];
    EXPECT_NE(remarks[0].find("that of all recordings"), std::string::npos) << remarks[0];
  }
  std::vector<std::string> remarks;
  Readout readout;
  take_rounding(rounding_of({coarse, coarse}), readout, remarks);
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_EQ(remarks[0].find("gimbal"), 0u) << "all are as coarse: " << remarks[0];
}

TEST(RoundingNoise, LeavesWhatIsDeclaredLargerOrWrittenFinely) {
  for (const double step : {0.001, 1e-7}) {
    Readout readout;
    std::vector<std::string> remarks;
    const double declared = readout.gimbal_noise;
    take_rounding(rounding_of({drifting(step)}), readout, remarks);
    EXPECT_EQ(readout.gimbal_noise, declared) << step;
    EXPECT_FALSE(readout.gimbals_rounded);
    EXPECT_TRUE(remarks.empty());
  }
}

}  // namespace
}  // namespace drift::preparation::rounding_noise_test
