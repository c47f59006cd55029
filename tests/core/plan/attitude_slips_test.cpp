#include "core/plan/attitude_slips.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>
#include <numbers>

#include "tests/support/attitude_scene.hpp"

namespace drift::attitude_slips_test {
namespace {

using test::expect_part;
using test::said_of;
using Scene = test::AttitudeScene;

TEST(AttitudeSlips, TriesUnitsAndHeadingsBeforeItGivesUp) {
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
  expect_part(said_of(times({"gimbal_outer", "gimbal_middle", "gimbal_inner"}, detail::deg)),
              "look like [rad], not [deg]");
  expect_part(said_of(times({"gimbal_outer", "gimbal_middle", "gimbal_inner"}, 1.0 / detail::deg,
                            unit::rad)),
              "look like [deg], not [rad]");
  for (const char* name : {"gimbal_outer", "gimbal_middle", "gimbal_inner"}) {
    const std::string is = fmt::format("{} is in another unit: the numbers look like ", name);
    expect_part(said_of(times({name}, detail::deg)), (is + "[rad], not [deg]").c_str());
    expect_part(said_of(times({name}, 1.0 / detail::deg, unit::rad)),
                (is + "[deg], not [rad]").c_str());
    expect_part(said_of(times({name}, 60.0)), (is + "[arcmin], not [deg]").c_str());
    expect_part(said_of(times({name}, 1.0 / (0.9 * detail::deg), unit::rad)),
                (is + "[gon], not [rad]").c_str());
  }
  // Whole turns hide what no middle gimbal can show.
  expect_part(said_of([](Scene& s) {
                for (double& v : s.column("gimbal_middle")) v += 14.0 * std::numbers::pi;
              }),
              "more than a turn");
  for (const int turns : {1, -1, 7})
    expect_part(said_of([=](Scene& s) {
                  for (double& v : s.column("gimbal_middle")) v += 2.0 * turns * std::numbers::pi;
                }),
                fmt::format("offset = {{ gimbal_middle = \"{} deg\" }}", -360 * turns).c_str());
  expect_part(said_of(times({"case_heading"}, -1.0)), "case_heading = \"-case_heading\"");
  expect_part(said_of(times({"case_heading"}, detail::deg)),
              "case_heading is in another unit: the numbers look like [rad], not [deg]");
  // The gimbals are those of a case that faces North; the column is of something else.
  expect_part(said_of([](Scene& s) {
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

TEST(AttitudeSlips, NamesTheUnitOfTheFewPositionsThatAreInAnother) {
  const auto said = [](std::initializer_list<double> where, double factor) {
    Scene s;
    const std::vector<double> position = s.column("position");
    for (const char* name : {"gimbal_outer", "gimbal_middle", "gimbal_inner"}) {
      std::ranges::find(s.recording.channels, name, &Channel::name)->unit = unit::rad;
      for (std::size_t i = 0; i < position.size(); ++i)
        if (std::ranges::find(where, position[i]) != where.end()) s.column(name)[i] *= factor;
    }
    const auto wrong = s.mistakes();
    EXPECT_EQ(wrong.size(), 1u);
    return wrong.empty() ? "" : wrong.front().text;
  };
  expect_part(said({1.0, 3.0}, 1.0 / detail::deg),
              "With angles in [deg], not [rad], they would be where");
  EXPECT_EQ(said({1.0, 3.0}, 1.7).find("With angles in"), std::string::npos);
}

TEST(AttitudeSlips, NamesTheZerosOfGimbalsThatBringAllIntoPlace) {
  const auto turned = [](std::initializer_list<std::pair<const char*, double>> by) {
    return said_of([=](Scene& s) {
      for (const auto& [name, deg] : by)
        for (double& v : s.column(name)) v += deg * detail::deg;
    });
  };
  expect_part(turned({{"gimbal_inner", 90.0}}),
              "gimbal_inner reads 90 deg too much, in all of them.");
  expect_part(turned({{"gimbal_inner", 90.0}}), "offset = { gimbal_inner = \"-90 deg\" }");
  expect_part(turned({{"gimbal_inner", -37.4}}), "offset = { gimbal_inner = \"37.4 deg\" }");
  expect_part(turned({{"gimbal_outer", 180.0}}), "offset = { gimbal_outer = \"");
  expect_part(turned({{"gimbal_middle", 25.0}}), "offset = { gimbal_middle = \"-25 deg\" }");
  expect_part(turned({{"gimbal_outer", 90.0}, {"gimbal_inner", -90.0}}),
              "offset = { gimbal_outer = \"-90 deg\", gimbal_inner = \"90 deg\" }");
  // Half of what one position is off would bring all within ten degrees, and is the zero of none.
  const std::string one = said_of([](Scene& s) {
    for (double& v : std::span(s.column("gimbal_inner")).last(s.recording.rows() / 12)) v += 0.3;
  });
  expect_part(one, "position 12");
  EXPECT_EQ(one.find("offset"), std::string::npos) << one;
}

}  // namespace
}  // namespace drift::attitude_slips_test
