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
#include "tests/support/model_builders.hpp"

namespace drift::attitude_check_test {
namespace {

/// Twelve positions as an ideal platform shows them.
struct Scene {
  TestPlan plan;
  Recording recording;

  explicit Scene(const char* preset = "twelve")
      : plan(preset_plan(preset, PlanDefaults{}).value()) {
    const Timeline timeline = lay_out(plan, test::harbin);
    Measurements m{Mat3X(3, timeline.intervals.size()), Mat3X(3, timeline.intervals.size())};
    for (std::size_t k = 0; k < timeline.intervals.size(); ++k) {
      const Interval& i = timeline.intervals[k];
      const Mat3& R_lr = timeline.nodes[i.last_node()].R_lr;
      m.acc.col(static_cast<Eigen::Index>(k)) = R_lr.row(2).transpose();
      m.gimbal.col(static_cast<Eigen::Index>(k)) =
          gimbal_angles<double>(case_attitude(i.heading1).transpose() * R_lr);
    }
    recording = make_recording(timeline, m, Readout{});
  }
  std::vector<double>& column(const char* name) {
    return std::ranges::find(recording.channels, name, &Channel::name)->values;
  }
  void reverse(const char* name) {
    for (double& v : column(name)) v = -v;
  }
  std::vector<RowMistake> mistakes() {
    try {
      lay_out(recording, plan, test::harbin);
    } catch (const InputError& e) {
      std::vector<RowMistake> all;
      for (const std::string& m : e.messages()) all.push_back({0, m});
      return all;
    }
    return {};
  }
};

void expect(const std::string& text, const char* part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

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
  for (const char* part : {"the order of positions", "in 2 of 12 positions",
                           "[recording] of the study file which is which: positions = { \"",
                           "the accelerometers and the gimbal angles agree with each other"})
    EXPECT_NE(wrong[0].text.find(part), std::string::npos) << wrong[0].text;
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
}

/// What is said where something was done to the columns of gimbals or heading; the case turns.
std::string said_of(const std::function<void(Scene&)>& spoil) {
  Scene s;
  Channel heading;
  heading.name = "case_heading";
  heading.unit = "deg"_unit;
  const Timeline timeline = lay_out(s.plan, test::harbin);
  for (std::size_t k = 0; k < timeline.intervals.size(); ++k) {
    const auto& i = timeline.intervals[k];
    const double turned = 0.3 + 0.2 * static_cast<double>(i.position);
    const Vec3 phi = gimbal_angles<double>(case_attitude(turned).transpose() *
                                           timeline.nodes[i.last_node()].R_lr);
    heading.values.push_back(turned);
    int a = 0;
    for (const char* name : {"gimbal_outer", "gimbal_middle", "gimbal_inner"})
      s.column(name)[k] = phi[a++];
  }
  std::erase_if(s.recording.channels, [](const Channel& c) { return c.name == "case_heading"; });
  s.recording.channels.push_back(heading);
  spoil(s);
  const auto wrong = s.mistakes();
  EXPECT_LE(wrong.size(), 1u);
  return wrong.empty() ? "" : wrong.front().text;
}

TEST(AttitudeCheck, TriesUnitsAndHeadingsBeforeItGivesUp) {
  const auto times = [](std::initializer_list<const char*> names, double factor,
                        Unit unit = unit::deg) {
    return [=](Scene& s) {
      for (const char* name : names) {
        std::ranges::find(s.recording.channels, name, &Channel::name)->unit = unit;
        for (double& v : s.column(name)) v *= factor;
      }
    };
  };
  EXPECT_EQ(said_of([](Scene&) {}), "");
  expect(said_of(times({"gimbal_outer", "gimbal_middle", "gimbal_inner"}, detail::deg)),
         "look like [rad], not [deg]");
  expect(said_of(times({"gimbal_outer", "gimbal_middle", "gimbal_inner"}, 1.0 / detail::deg,
                       unit::rad)),
         "look like [deg], not [rad]");
  for (const char* name : {"gimbal_outer", "gimbal_middle", "gimbal_inner"}) {
    const std::string is = fmt::format("{} is in another unit: the numbers look like ", name);
    expect(said_of(times({name}, detail::deg)), (is + "[rad], not [deg]").c_str());
    expect(said_of(times({name}, 1.0 / detail::deg, unit::rad)), (is + "[deg], not [rad]").c_str());
    expect(said_of(times({name}, 60.0)), (is + "[arcmin], not [deg]").c_str());
    expect(said_of(times({name}, 1.0 / (0.9 * detail::deg), unit::rad)),
           (is + "[gon], not [rad]").c_str());
  }
  // Whole turns hide what no middle gimbal can show.
  expect(said_of([](Scene& s) {
           for (double& v : s.column("gimbal_middle")) v += 14.0 * std::numbers::pi;
         }),
         "more than a turn");
  expect(said_of(times({"case_heading"}, -1.0)), "case_heading = \"-case_heading\"");
  expect(said_of(times({"case_heading"}, detail::deg)),
         "case_heading is in another unit: the numbers look like [rad], not [deg]");
  // The gimbals are those of a case that faces North; the column is of something else.
  expect(said_of([](Scene& s) {
           const Timeline timeline = lay_out(s.plan, test::harbin);
           for (std::size_t k = 0; k < timeline.intervals.size(); ++k) {
             const Vec3 phi =
                 gimbal_angles<double>(timeline.nodes[timeline.intervals[k].last_node()].R_lr);
             int a = 0;
             for (const char* name : {"gimbal_outer", "gimbal_middle", "gimbal_inner"})
               s.column(name)[k] = phi[a++];
           }
         }),
         "case_heading");
}

TEST(AttitudeCheck, NamesTheZerosOfGimbalsThatBringAllIntoPlace) {
  const auto turned = [](std::initializer_list<std::pair<const char*, double>> by) {
    return said_of([=](Scene& s) {
      for (const auto& [name, deg] : by)
        for (double& v : s.column(name)) v += deg * detail::deg;
    });
  };
  expect(turned({{"gimbal_inner", 90.0}}), "gimbal_inner reads 90 deg too much, in all of them.");
  expect(turned({{"gimbal_inner", 90.0}}), "offset = { gimbal_inner = \"-90 deg\" }");
  expect(turned({{"gimbal_inner", -37.4}}), "offset = { gimbal_inner = \"37.4 deg\" }");
  expect(turned({{"gimbal_outer", 180.0}}), "offset = { gimbal_outer = \"");
  expect(turned({{"gimbal_middle", 25.0}}), "offset = { gimbal_middle = \"-25 deg\" }");
  expect(turned({{"gimbal_outer", 90.0}, {"gimbal_inner", -90.0}}),
         "offset = { gimbal_outer = \"-90 deg\", gimbal_inner = \"90 deg\" }");
  // Half of what one position is off would bring all within ten degrees, and is the zero of none.
  const std::string one = said_of([](Scene& s) {
    for (double& v : std::span(s.column("gimbal_inner")).last(s.recording.rows() / 12)) v += 0.3;
  });
  expect(one, "position 12");
  EXPECT_EQ(one.find("offset"), std::string::npos) << one;
}

}  // namespace
}  // namespace drift::attitude_check_test
