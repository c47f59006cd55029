#include "core/recording/rows/reduce.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace drift::reduce_test {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Two positions of `rows` samples each, 0.5 s apart, 1000 s between them; acc_x = f(time).
Recording recording(std::size_t rows, auto&& f) {
  Recording r;
  r.channels = {{"time", unit::s, {}},
                {"position", unit::one, {}},
                {"acc_x", unit::g, {}},
                {"gimbal_outer", unit::deg, {}},
                {"cmd_x", unit::deg_per_h, {}}};
  for (std::size_t k = 0; k < 2 * rows; ++k) {
    const double t = 0.5 * static_cast<double>(k + 1) + (k < rows ? 0.0 : 1000.0);
    r.channels[0].values.push_back(t);
    r.channels[1].values.push_back(k < rows ? 1.0 : 2.0);
    r.channels[2].values.push_back(f(t));
    r.channels[3].values.push_back(0.001 * t);
    r.channels[4].values.push_back(k < rows ? 0.0 : 1e-5);
    r.lines.push_back(k + 2);
  }
  return r;
}

TEST(Reduce, TakesMeansOfAccelerometersAndAnglesAtTheEnd) {
  const Recording r = recording(40, [](double t) { return 0.25 * t; });
  const SampleIntervals found = sample_intervals(r);
  EXPECT_DOUBLE_EQ(found.typical, 0.5);
  EXPECT_DOUBLE_EQ(found.shortest_position, 20.0);
  const Recording s = reduced(r, 0.5, 8);
  ASSERT_EQ(s.rows(), 10u);
  const auto& t = s.find("time")->values;
  for (std::size_t k = 0; k < 10; ++k) {
    EXPECT_DOUBLE_EQ(t[k], (k < 5 ? 0.0 : 1020.0) + 4.0 * static_cast<double>(k % 5 + 1));
    // Samples t - 3.5 ... t: their mean is the value at t - 1.75.
    EXPECT_NEAR(s.find("acc_x")->values[k], 0.25 * (t[k] - 1.75), 1e-12);
    EXPECT_NEAR(s.find("gimbal_outer")->values[k], 0.001 * t[k], 1e-15);
    EXPECT_DOUBLE_EQ(s.find("position")->values[k], k < 5 ? 1.0 : 2.0);
    EXPECT_EQ(s.lines[k], r.lines[8 * k + 7]);
  }
}

TEST(Reduce, BridgesShortHolesAlongTheTrendAndLeavesLongOnesEmpty) {
  Recording r = recording(40, [](double t) { return 3.0 - 0.1 * t; });
  auto& x = r.channels[2].values;
  x[0] = x[1] = x[2] = none;                         // 3 of 8
  for (std::size_t k = 8; k < 13; ++k) x[k] = none;  // 5 of 8
  const Recording s = reduced(r, 0.5, 8);
  EXPECT_NEAR(s.find("acc_x")->values[0], 3.0 - 0.1 * 2.25, 1e-12);
  EXPECT_TRUE(std::isnan(s.find("acc_x")->values[1]));
  EXPECT_TRUE(std::isfinite(s.find("acc_x")->values[2]));
}

TEST(Reduce, TakesCovariatesAsTheyAreAtTheEnd) {
  Recording r = recording(40, [](double) { return 1.0; });
  Channel temperature{"temperature", "degC"_unit, {}}, oil{"oil", unit::one, {}};
  for (const double t : r.channels[0].values) {
    temperature.values.push_back(20.0 + 0.01 * t);
    oil.values.push_back(7.3);
  }
  r.channels.insert(r.channels.end(), {temperature, oil});
  const Recording s = reduced(r, 0.5, 8);
  const auto& t = s.find("time")->values;
  for (std::size_t k = 0; k < s.rows(); ++k) {
    EXPECT_NEAR(s.find("temperature")->values[k], 20.0 + 0.01 * t[k], 1e-12) << t[k];
    EXPECT_EQ(s.find("oil")->values[k], 7.3);
  }
}

TEST(Reduce, CutsWhereACommandChanges) {
  Recording r = recording(40, [](double) { return 1.0; });
  for (std::size_t k = 11; k < 40; ++k)
    r.channels[4].values[k] = 2e-5;  // within the second stretch
  const Recording s = reduced(r, 0.5, 8);
  const auto& cmd = s.find("cmd_x")->values;
  const auto& t = s.find("time")->values;
  for (std::size_t k = 0; k < s.rows(); ++k)
    EXPECT_DOUBLE_EQ(cmd[k], t[k] > 1000.0 ? 1e-5 : t[k] > 5.5 ? 2e-5 : 0.0) << t[k];
  EXPECT_DOUBLE_EQ(t[1], 5.5);
  EXPECT_DOUBLE_EQ(t[2], 9.5);
}

TEST(Reduce, AFactorOfOneChangesNothing) {
  const Recording r = recording(10, [](double t) { return std::sin(t); });
  const Recording s = reduced(r, 0.5, 1);
  for (std::size_t c = 0; c < r.channels.size(); ++c)
    EXPECT_EQ(s.channels[c].values, r.channels[c].values);
}

}  // namespace
}  // namespace drift::reduce_test
