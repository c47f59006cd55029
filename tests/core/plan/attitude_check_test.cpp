// A recording whose columns are not what they are called.
#include "core/plan/attitude_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <numbers>
#include <span>

#include "core/base/check.hpp"
#include "core/sim/measurements.hpp"
#include "tests/support/attitude_scene.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::attitude_check_test {
namespace {

using test::expect_part;
using Scene = test::AttitudeScene;

TEST(AttitudeCheck, SaysNothingOfARecordingOfThePlan) {
  EXPECT_TRUE(Scene().mistakes().empty());
}

TEST(AttitudeCheck, NamesTheColumnWhoseSignIsWrong) {
  for (const char* name : {"acc_x", "acc_y", "acc_z", "gimbal_outer", "gimbal_middle"}) {
    Scene s;
    s.reverse(name);
    const auto wrong = s.mistakes();
    ASSERT_EQ(wrong.size(), 1u) << name << ": " << wrong.front().text;
    EXPECT_NE(wrong[0].text.find(fmt::format("column {}: the sign is wrong", name)),
              std::string::npos)
        << wrong[0].text;
    EXPECT_NE(wrong[0].text.find(fmt::format("{{ {} = \"-{}\" }}", name, name)), std::string::npos)
        << wrong[0].text;
  }
}

TEST(AttitudeCheck, NamesThemWhereThePlatformIsSlewedFromPositionToPosition) {
  EXPECT_TRUE(Scene("slew12").mistakes().empty());
  for (const char* name : {"acc_x", "acc_y", "acc_z", "gimbal_outer", "gimbal_inner"}) {
    Scene s("slew12");
    s.reverse(name);
    const auto wrong = s.mistakes();
    ASSERT_EQ(wrong.size(), 1u) << name;
    EXPECT_NE(wrong[0].text.find(fmt::format("column {}: the sign is wrong", name)),
              std::string::npos)
        << wrong[0].text;
  }
}

TEST(AttitudeCheck, NamesTheUnitOfAnglesWithWhichThePlatformWouldHaveTurnedAsCommanded) {
  for (const Unit& true_unit : {unit::rad, unit::arcsec}) {
    Scene s("slew12");
    const Unit said = s.recording.find("gimbal_outer")->unit;
    ASSERT_NE(said.to_si, true_unit.to_si);
    for (const char* name : {"gimbal_outer", "gimbal_middle", "gimbal_inner"})
      for (double& x : s.column(name)) x *= said.to_si / true_unit.to_si;
    const auto wrong = s.mistakes();
    ASSERT_FALSE(wrong.empty());
    expect_part(wrong.front().text,
                fmt::format("turned as commanded if the numbers are in [{}], not [{}]",
                            true_unit.symbol.view(), said.symbol.view())
                    .c_str());
  }
}

TEST(AttitudeCheck, ACommandThatFewSlewsFollowIsToldByThese) {
  // In twelve slews an axis is turned about by a third of the turns: the median knows nothing of
  // it.
  for (const double dwell : {600.0, 1200.0, 1800.0}) {
    EXPECT_TRUE(Scene("slew12", dwell).mistakes().empty()) << dwell;
    for (const char* name : {"cmd_x", "cmd_y", "cmd_z"}) {
      Scene s("slew12", dwell);
      s.reverse(name);
      const auto wrong = s.mistakes();
      ASSERT_EQ(wrong.size(), 1u) << name << " " << dwell;
      expect_part(wrong.front().text, fmt::format("column {}: the sign is wrong", name).c_str());
    }
  }
}

/// The values of a column so many rows later, or earlier.
void shift(std::vector<double>& values, int rows) {
  const std::vector<double> was = values;
  const int last = static_cast<int>(was.size()) - 1;
  for (int k = 0; k <= last; ++k)
    values[static_cast<std::size_t>(k)] =
        was[static_cast<std::size_t>(std::clamp(k - rows, 0, last))];
}

/// The numbers come too early, or rows on the way have the number of where it leads.
TEST(AttitudeCheck, FirstRowsThatShowAnotherAttitudeAreToldAsThat) {
  for (const auto& [rows, last] : {std::pair<std::size_t, double>{2, 12.0}, {3, 12.0}, {2, 2.0}}) {
    Scene s;
    const std::vector<double> position = s.column("position");
    for (std::size_t k = rows; k < position.size(); ++k)
      if (position[k] != position[k - rows] && position[k] <= last)
        for (Channel& c : s.recording.channels)
          if (c.name.starts_with("acc_") || c.name.starts_with("gimbal_"))
            c.values[k] = c.values[k - 1];
    const auto wrong = s.mistakes();
    ASSERT_EQ(wrong.size(), 1u) << rows;
    expect_part(wrong.front().text,
                fmt::format("the first rows of {} position{}, up to {}, show another", last - 1.0,
                            last > 2.0 ? "s" : "", rows)
                    .c_str());
  }
}

TEST(AttitudeCheck, CommandsThatStandRowsTooLateOrTooEarlyAreToldAsThat) {
  for (const int rows : {1, 2, -1, -2}) {
    Scene commands("slew12"), gimbals("slew12");
    for (const char* name : {"cmd_x", "cmd_y", "cmd_z"}) shift(commands.column(name), rows);
    for (const char* name : {"gimbal_outer", "gimbal_middle", "gimbal_inner"})
      shift(gimbals.column(name), -rows);
    const std::string said =
        fmt::format("{} row{} too {}", std::abs(rows), std::abs(rows) == 1 ? "" : "s",
                    rows > 0 ? "late" : "early");
    for (Scene* s : {&commands, &gimbals}) {
      const auto wrong = s->mistakes();
      ASSERT_EQ(wrong.size(), 1u) << rows;
      expect_part(wrong.front().text, ("cmd_x, cmd_y, cmd_z stand " + said).c_str());
    }
  }
}

TEST(AttitudeCheck, ASlewThatTurnsOtherwiseThanCommandedIsOfCommandsOrGimbals) {
  using Names = std::pair<const char*, const char*>;
  const auto said = [](const auto& spoil) {
    Scene s("slew12");
    spoil(s);
    const auto wrong = s.mistakes();
    EXPECT_EQ(wrong.size(), 1u);
    return wrong.empty() ? "" : wrong.front().text;
  };
  for (const auto& [a, b] :
       {Names{"cmd_x", "cmd_y"}, Names{"cmd_z", "cmd_x"}, Names{"gimbal_outer", "gimbal_middle"},
        Names{"gimbal_inner", "gimbal_outer"}, Names{"acc_x", "acc_z"}, Names{"acc_y", "acc_x"}}) {
    const std::string text =
        said([&, a = a, b = b](Scene& s) { std::swap(s.column(a), s.column(b)); });
    EXPECT_NE(text.find(fmt::format("{} = \"{}\"", a, b)), std::string::npos) << text;
    EXPECT_NE(text.find(fmt::format("{} = \"{}\"", b, a)), std::string::npos) << text;
    EXPECT_EQ(text.find("Or "), std::string::npos) << text;
  }
  for (const char* name : {"cmd_x", "cmd_y", "cmd_z"}) {
    const std::string text = said([&](Scene& s) { s.reverse(name); });
    EXPECT_NE(text.find(fmt::format("column {}: the sign is wrong", name)), std::string::npos)
        << text;
  }
  EXPECT_NE(said([](Scene& s) {
              for (const char* name : {"cmd_x", "cmd_y", "cmd_z"})
                for (double& v : s.column(name)) v /= 3600.0;
            }).find("as if they were in [deg/s], not [deg/h]"),
            std::string::npos);
  EXPECT_NE(said([](Scene& s) {
              std::ranges::reverse(s.column("cmd_x"));
              std::ranges::reverse(s.column("cmd_y"));
              std::ranges::reverse(s.column("cmd_z"));
            }).find("turns of slews the gimbals do not turn as commanded"),
            std::string::npos);
}

TEST(AttitudeCheck, SlewedAsCommandedToOtherAttitudesItIsAnotherPlanOrAZero) {
  Scene half("slew12");  // positions 4 to 9, numbered from 1
  const auto& number = half.column("position");
  const long first = std::ranges::find(number, 4.0) - number.begin();
  const long end = std::ranges::find(number, 10.0) - number.begin();
  for (Channel& c : half.recording.channels) {
    c.values = {c.values.begin() + first, c.values.begin() + end};
    if (c.name == "position")
      for (double& p : c.values) p -= 3.0;
  }
  half.recording.lines.resize(static_cast<std::size_t>(end - first));
  auto wrong = half.mistakes();
  ASSERT_EQ(wrong.size(), 1u);
  EXPECT_NE(wrong[0].text.find("agree with each other and are away from the attitude in the plan"),
            std::string::npos)
      << wrong[0].text;
  Scene zero("slew12");
  for (double& v : zero.column("gimbal_outer")) v += std::numbers::pi;
  wrong = zero.mistakes();
  ASSERT_EQ(wrong.size(), 1u);
  const std::string reads = "gimbal_outer reads ";
  const std::size_t at = wrong[0].text.find(reads);
  ASSERT_NE(at, std::string::npos) << wrong[0].text;
  // To a sample's turn of the platform and the noise of a gimbal.
  EXPECT_NEAR(std::abs(std::stod(wrong[0].text.substr(at + reads.size()))), 180.0, 0.5);
}

TEST(AttitudeCheck, NamesColumnsThatAreExchanged) {
  Scene s;
  std::swap(s.column("acc_x"), s.column("acc_z"));
  const auto wrong = s.mistakes();
  ASSERT_EQ(wrong.size(), 1u);
  EXPECT_NE(wrong[0].text.find("acc_x = \"acc_z\", acc_z = \"acc_x\""), std::string::npos)
      << wrong[0].text;
}

TEST(AttitudeCheck, NamesThePositionsWhereNoMixupOfColumnsIsBehind) {
  Scene s;
  std::swap(s.plan.positions[0], s.plan.positions[2]);
  const auto wrong = s.mistakes();
  ASSERT_EQ(wrong.size(), 1u) << "both kinds of instrument agree: it is the plan";
  for (const char* part :
       {"in 2 of 12 positions",
        "[[plan.position]] of the study file into the order in which they were held: 3, 2, 1, 4, 5",
        "the accelerometers and the gimbal angles agree with each other"})
    EXPECT_NE(wrong[0].text.find(part), std::string::npos) << wrong[0].text;
  EXPECT_EQ(wrong[0].text.find("positions = {"), std::string::npos) << "it would not help";
  // Where they do not agree, something is wrong with both.
  s.reverse("acc_y");
  EXPECT_EQ(s.mistakes().size(), 2u);
}

TEST(AttitudeCheck, NamesColumnsThatStandARowLate) {
  const auto late = [](Scene& s, std::initializer_list<const char*> names) {
    for (const char* name : names) {
      std::vector<double>& rows = s.column(name);
      std::rotate(rows.begin(), rows.end() - 1, rows.end());
    }
  };
  const auto said = [](Scene& s) {
    const auto wrong = s.mistakes();
    EXPECT_EQ(wrong.size(), 1u);
    return wrong.empty() ? "" : wrong.front().text;
  };
  Scene all, one, gimbals, both;
  late(all, {"acc_x", "acc_y", "acc_z"});
  EXPECT_NE(said(all).find("still shows the attitude before, the second row that of the plan: "
                           "columns acc_x, acc_y, acc_z stand a row late"),
            std::string::npos);
  late(one, {"acc_y"});
  EXPECT_NE(said(one).find("column acc_y stands a row late"), std::string::npos) << said(one);
  late(gimbals, {"gimbal_outer", "gimbal_middle", "gimbal_inner"});
  EXPECT_NE(said(gimbals).find("gimbal_outer, gimbal_middle, gimbal_inner stand a row late"),
            std::string::npos)
      << said(gimbals);
  std::vector<double>& labels = both.column("position");
  std::rotate(labels.begin(), labels.begin() + 1, labels.end());
  both.column("position").back() = 12.0;
  EXPECT_NE(said(both).find("the numbers of the positions change a row early"), std::string::npos)
      << said(both);
  // Rows may be lost behind the first: the platform was caged meanwhile.
  for (std::size_t k = 1; k + 1 < labels.size(); ++k)
    for (const char* name :
         {"acc_x", "acc_y", "acc_z", "gimbal_outer", "gimbal_middle", "gimbal_inner"})
      if (labels[k] != labels[k - 1]) both.column(name)[k + 1] = nan_value;
  EXPECT_NE(said(both).find("the numbers of the positions change a row early"), std::string::npos)
      << said(both);
}

/// A zero that is off by just as much as makes another attitude, and drift or a bad reading beside:
/// the first row is elsewhere, the second is not, and none shows the position before.
TEST(AttitudeCheck, AZeroAtTheLimitIsNoRowThatComesLate) {
  Scene s;
  const std::vector<double>& position = s.column("position");
  std::vector<double>& outer = s.column("gimbal_outer");
  for (std::size_t k = 0; k < outer.size(); ++k) {
    const bool first = k == 0 || position[k] != position[k - 1];
    // The platform itself turns by 0.25 deg from row to row.
    outer[k] += (first ? 10.2 : 9.4) * detail::deg;
  }
  const auto wrong = s.mistakes();
  ASSERT_EQ(wrong.size(), 1u);
  expect_part(wrong[0].text, "gimbal_outer reads 10.2 deg too much");
  expect_part(wrong[0].text, "offset = { gimbal_outer = \"-10.2 deg\" }");
}

}  // namespace
}  // namespace drift::attitude_check_test
