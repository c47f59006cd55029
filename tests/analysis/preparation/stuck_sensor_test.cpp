// A sensor that stands still, and one that reads in coarse steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/preparation/prepare.hpp"
#include "tests/support/six_positions.hpp"

namespace drift::preparation::stuck_sensor_test {
namespace {

using test::channel;
using test::says;
using test::simulated;

TEST(Prepare, AStuckChannelIsLeftOutAndACoarseOneIsNot) {
  const mc::Study s = test::six_study(1800.0);
  Recording r = simulated(s);
  auto& stuck = channel(r, "acc_y");
  std::fill(stuck.begin(), stuck.end(), 0.5);
  auto& burst = channel(r, "gimbal_inner");
  std::fill(burst.begin() + 40, burst.begin() + 70, burst[40]);
  auto& coarse = channel(r, "acc_z");  // resolution 0.02 g: whole positions may read the same
  for (double& x : coarse) x = 0.02 * std::round(x / 0.02);
  const Prepared p = prepare(s, {r});
  EXPECT_FALSE(says(p, "acc_z stands still"));
  EXPECT_TRUE(says(p, "acc_z is written in steps of 0.02 g"));
  EXPECT_TRUE(std::ranges::all_of(p.recordings[0].find("acc_z")->values,
                                  [](double x) { return std::isfinite(x); }));
  EXPECT_TRUE(says(p, "acc_y stands still for 180 samples"));
  EXPECT_TRUE(says(p, "gimbal_inner stands still for 30 samples, from line 41"));
  EXPECT_TRUE(std::isnan(p.recordings[0].find("acc_y")->values[0]));
  EXPECT_TRUE(std::isnan(p.recordings[0].find("gimbal_inner")->values[69]));
  EXPECT_TRUE(std::isfinite(p.recordings[0].find("gimbal_inner")->values[70]));
}

TEST(Prepare, ACoarseReadoutThatFlickersHereAndStandsThereIsNoStuckSensor) {
  // Between two steps it changes from row to row, on one of them it stays for a whole dwell.
  const mc::Study s = test::six_study(1800.0);
  Recording r = simulated(s);
  auto& x = channel(r, "acc_x");
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] = 1e-3 * (std::round(x[i] / 1e-3) + (i < 120 && i % 2 == 0 ? 1.0 : 0.0));
  std::fill(x.begin() + 120, x.begin() + 150, x[120]);
  const Prepared p = prepare(s, {r});
  EXPECT_FALSE(says(p, "stands still"));
  EXPECT_TRUE(std::ranges::all_of(p.recordings[0].find("acc_x")->values,
                                  [](double value) { return std::isfinite(value); }));
}

}  // namespace
}  // namespace drift::preparation::stuck_sensor_test
