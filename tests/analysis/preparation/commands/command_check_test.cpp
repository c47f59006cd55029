// Recorded commands of level dwells that are not what held the platform.
#include "analysis/preparation/commands/command_check.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>

#include "analysis/preparation/prepare.hpp"
#include "core/base/check.hpp"
#include "tests/support/six_positions.hpp"

namespace drift::preparation::command_check_test {
namespace {

/// Without drift, which would turn the platform as a small part of a command does.
mc::Study level_study() {
  PlanDefaults defaults;
  defaults.dwell = 1200.0;
  defaults.mode = CommandLaw::level;
  mc::Study s = test::six_study(defaults);
  for (Prior& prior : s.truth.priors) prior = fixed(0.0);
  return s;
}

constexpr const char* commands[] = {"cmd_x", "cmd_y", "cmd_z"};

void multiply(Recording& r, std::initializer_list<const char*> columns, double factor) {
  for (const char* name : columns)
    for (double& x : test::channel(r, name)) x *= factor;
}

void in_deg_per_h(Recording& r) {
  for (Channel& c : r.channels)
    if (c.name.starts_with("cmd_")) c.unit = unit::deg_per_h;
}

/// What was said of a recording that was spoiled: refused, or remarked.
struct Said {
  std::string refused, remarked;
};

Said said(const mc::Study& s, const std::function<void(Recording&)>& spoil) {
  Recording r = test::simulated(s);
  in_deg_per_h(r);
  spoil(r);
  Said out;
  try {
    for (const std::string& remark : prepare(s, {r}).remarks) out.remarked += remark + "\n";
  } catch (const InputError& error) {
    out.refused = error.what();
  }
  return out;
}

void expect_part(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST(CommandCheck, ColumnsOfAnotherSignOrExchangedAreRefusedWithTheLineThatMendsThem) {
  const mc::Study s = level_study();
  EXPECT_EQ(said(s, [](Recording&) {}).remarked, "");
  for (const std::string name : commands) {
    const Said one = said(s, [&](Recording& r) { multiply(r, {name.c_str()}, -1.0); });
    expect_part(one.refused, "column " + name + ": the sign is wrong");
    expect_part(one.refused, "columns = { " + name + " = \"-" + name + "\" }");
    EXPECT_EQ(one.refused.find("latitude"), std::string::npos) << one.refused;
  }
  expect_part(said(s,
                   [](Recording& r) {
                     multiply(r, {"cmd_x", "cmd_y", "cmd_z"}, -1.0);
                   })
                  .refused,
              "cmd_x = \"-cmd_x\", cmd_y = \"-cmd_y\", cmd_z = \"-cmd_z\"");
  for (const auto& [a, b] : {std::pair{"cmd_x", "cmd_y"}, {"cmd_y", "cmd_z"}, {"cmd_x", "cmd_z"}}) {
    const Said two = said(
        s, [a = a, b = b](Recording& r) { std::swap(test::channel(r, a), test::channel(r, b)); });
    expect_part(two.refused, fmt::format("{} = \"{}\", {} = \"{}\"", a, b, b, a));
  }
  const Said turned = said(s, [](Recording& r) {
    std::swap(test::channel(r, "cmd_x"), test::channel(r, "cmd_y"));
    std::swap(test::channel(r, "cmd_y"), test::channel(r, "cmd_z"));
  });
  expect_part(turned.refused, "cmd_x = \"cmd_z\", cmd_y = \"cmd_x\", cmd_z = \"cmd_y\"");
}

TEST(CommandCheck, ThePlatformMustStandForThat) {
  const mc::Study s = level_study();
  // Nothing measured tells whether it does.
  const Said blind = said(s, [](Recording& r) {
    multiply(r, {"cmd_x"}, -1.0);
    for (const char* name : {"gimbal_outer", "gimbal_middle", "gimbal_inner"})
      for (double& x : test::channel(r, name)) x = nan_value;
    for (const char* name : {"acc_x", "acc_y", "acc_z"})
      for (double& x : test::channel(r, name)) x = nan_value;
  });
  EXPECT_EQ(blind.refused.find("sign is wrong"), std::string::npos) << blind.refused;
  // Free drift against a plan that is level is one law for another, no factor of zero.
  mc::Study free = s;
  for (Position& p : free.plan.positions) p.mode = CommandLaw::free;
  const Recording drifting = test::simulated(free);
  EXPECT_TRUE(test::says(prepare(s, {drifting}), "are those of a free dwell"));
}

TEST(CommandCheck, OneLatitudeIsSaidWhereAllDwellsShowIt) {
  mc::Study elsewhere = level_study();
  const Recording r = test::simulated(elsewhere);
  elsewhere.site.latitude = 50.0 * unit::deg.to_si;
  EXPECT_TRUE(test::says(prepare(elsewhere, {r}),
                         "in positions 1 to 6 are the Earth rate at latitude 45.750 deg, [site] "
                         "says 50.000 deg"));
  // Some of them are of another: no latitude is.
  Recording some = r;
  const std::size_t half = some.rows() / 2;
  for (const char* name : commands)
    for (std::size_t k = 0; k < half; ++k) test::channel(some, name)[k] = 0.0;
  const Prepared p = prepare(elsewhere, {some});
  EXPECT_FALSE(test::says(p, "latitude"));
  EXPECT_TRUE(test::says(p, "of neither law"));
}

TEST(CommandCheck, CommandsInAnotherUnitAreRefusedWithIt) {
  mc::Study s = level_study();
  // A platform that nothing commands, and that stands, has another clock: this one drifts.
  for (const char* key : {"D_F_x", "D_F_y", "D_F_z"})
    s.truth.priors[test::param(key)] = fixed(unit::deg_per_h.to_si);
  const auto times = [&](double factor) {
    return said(s, [=](Recording& r) { multiply(r, {"cmd_x", "cmd_y", "cmd_z"}, factor); }).refused;
  };
  expect_part(times(1.0 / 3600.0),
              "cmd_x, cmd_y and cmd_z are 0.0002778 times the plan's commands "
              "in all 6 level dwells, in which the platform stands: the "
              "numbers look like [deg/s], not [deg/h]. Correct the unit");
  expect_part(times(detail::deg / 3600.0), "look like [rad/s], not [deg/h]");
  expect_part(times(detail::deg), "look like [rad/h], not [deg/h]");
  expect_part(times(0.5), "0.5 times the plan's commands");
  expect_part(times(0.5), "Correct the unit or the pulse weight");
  expect_part(times(0.0), "cmd_x, cmd_y and cmd_z are zero");
  expect_part(said(level_study(), [](Recording& r) { multiply(r, {"cmd_z"}, 1.1); }).refused,
              "cmd_z is 1.1 times the plan's commands in all 6 level dwells");
}

/// 0.5 % is what the prior of a torquer's scale holds.
TEST(CommandCheck, ASmallFactorIsRemarkedBeyondThePriorOfTheTorquersScale) {
  const mc::Study s = level_study();
  const auto remarked = [&](const mc::Study& study, double factor) {
    return said(study, [=](Recording& r) { multiply(r, {"cmd_y"}, factor); }).remarked;
  };
  EXPECT_EQ(remarked(s, 1.004), "");
  expect_part(remarked(s, 1.01), "cmd_y is 1.01 times the plan's commands");
  expect_part(remarked(s, 1.01), "within 5 prior sigmas of s_y");
  mc::Study wide = s;
  wide.filters.front().priors[test::param("s_y")] = normal(0.0, 0.01);
  EXPECT_EQ(remarked(wide, 1.01), "");
  // Compensated drift is no factor.
  EXPECT_EQ(said(s,
                 [](Recording& r) {
                   for (double& x : test::channel(r, "cmd_y")) x += 0.3 * unit::deg_per_h.to_si;
                 })
                .remarked,
            "");
}

}  // namespace
}  // namespace drift::preparation::command_check_test
