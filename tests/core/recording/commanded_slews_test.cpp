// Slews of logs with numbers of positions and commands, but no phase.
#include "core/recording/rows/commanded_slews.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "recording_fixture.hpp"

namespace drift::commanded_slews_test {
namespace {

/// Rows of 10 s: six in each of two positions, four between them in which a command turns the
/// platform by 20 deg each. `number` of a row, counted from 0.
template <class Number>
Recording turned_by_commands(Number&& number, double caged_by = 0.0) {
  Recording r;
  for (const char* name : {"time", "position", "gimbal_outer", "gimbal_middle", "gimbal_inner",
                           "cmd_x", "cmd_y", "cmd_z"})
    r.channels.push_back({name, unit::one, std::vector<double>(16, 0.0)});
  constexpr double step = 20.0 * detail::deg;
  for (std::size_t k = 0; k < 16; ++k) {
    r.lines.push_back(k + 2);
    r.channels[0].values[k] = 10.0 * static_cast<double>(k + 1);
    r.channels[1].values[k] = number(k);
    const double turns = k < 6 ? 0.0 : k < 10 ? static_cast<double>(k - 5) : 4.0;
    r.channels[2].values[k] = step * turns + (k < 10 ? 0.0 : caged_by);
    r.channels[5].values[k] = k >= 6 && k < 10 ? step / 10.0 : 0.0;
  }
  return r;
}

const std::vector<double> six_of_each = {1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2};

TEST(CommandedSlews, AreTheWayToTheNextPositionWhereverItsNumberBegins) {
  for (std::size_t change = 3; change <= 13; ++change) {
    Recording r = turned_by_commands([&](std::size_t k) { return k < change ? 1.0 : 2.0; });
    take_commanded_slews(r);
    ASSERT_NE(r.find("phase"), nullptr) << change;
    EXPECT_EQ(r.find("phase")->values,
              (std::vector<double>{0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0}));
    EXPECT_EQ(r.find("position")->values, six_of_each) << change;
    EXPECT_NE(testing::PrintToString(r.remarks.texts()).find("4 rows beside a change"),
              std::string::npos);
  }
}

TEST(CommandedSlews, OtherCommandsAreThoseOfADwell) {
  const auto untouched = [](Recording r) {
    const std::vector<double> was = r.find("position")->values;
    take_commanded_slews(r);
    return r.find("phase") == nullptr && r.find("position")->values == was;
  };
  const auto half = [](std::size_t k) { return k < 6 ? 1.0 : 2.0; };
  EXPECT_FALSE(untouched(turned_by_commands(half)));
  EXPECT_TRUE(untouched(turned_by_commands([](std::size_t) { return 1.0; }))) << "in a position";
  EXPECT_TRUE(untouched(turned_by_commands(half, 90.0 * detail::deg))) << "caged behind them";
  EXPECT_TRUE(untouched(turned_by_commands([](std::size_t k) { return k < 2 ? 1.0 : 2.0; })));
  Recording always = turned_by_commands(half);
  for (double& x : always.channels[5].values) x = 1e-3;
  EXPECT_TRUE(untouched(always));
  Recording level = turned_by_commands(half);
  for (double& x : level.channels[5].values) x = detail::earth_rate;
  EXPECT_TRUE(untouched(level));
}

}  // namespace
}  // namespace drift::commanded_slews_test
