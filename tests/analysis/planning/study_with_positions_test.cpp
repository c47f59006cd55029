// A study whose plan is written out position by position is read as that plan.
#include "analysis/planning/study_with_positions.hpp"

#include <gtest/gtest.h>

#include "core/base/check.hpp"

namespace drift::planning::study_with_positions_test {
namespace {

constexpr const char* head = R"(schema = 1
title  = "mine"
[site]
latitude = "45.75 deg"
)";
constexpr const char* filter = R"([[filter]]
name     = "f"
coupling = "eq5"
terms    = ["fixed_drift"]
)";
/// Keys behind that of the preset, one of which has no place in a position.
constexpr const char* preset = R"([plan]
preset    = "six"
dwell     = "10 min"
sample    = "60 s"
mode      = "free"
slew_rate = "0.25 deg/s"
)";
/// Positions that take over what [plan] has by default.
constexpr const char* listed = R"([plan]
dwell  = "20 min"
sample = "60 s"
mode   = "level"
entry  = "torqued"
[[plan.position]]
name = "mine"
axes = "x=N y=W z=U"
[[plan.position]]
axes  = "x=N y=U z=E"
dwell = "5 min"
[[plan.position]]
axes  = "x=N y=W z=U"
turn  = "10 deg about y"
[[plan.position]]
axes  = "x=N y=W z=U"
turn  = ["10 deg about y", "0.2 rad about x"]
)";

mc::Study study(const std::string& plan, const std::string& more = "",
                const mc::Overrides& set = {}) {
  return mc::read_study_text(head + plan + filter + more, "s.toml", set);
}

Position added() {
  Position p;
  p.name = "added 1";
  p.axes = "x=U y=N z=W";
  p.dwell = 1234.0;
  p.sample = 2.0;
  p.mode = CommandLaw::level;
  p.entry = Entry::torqued;
  p.case_heading = 0.5 * detail::deg;
  return p;
}

void expect_position(const Position& is, const Position& was, const std::string& what) {
  std::string why;
  EXPECT_EQ(is.name, was.name) << what;
  EXPECT_EQ(attitude_text(is), attitude_text(was)) << what;
  EXPECT_EQ(is.R_lp, parse_axes(was.axes, why).value() * rotation_of(was.turns)) << what;
  EXPECT_DOUBLE_EQ(is.dwell, was.dwell) << what;
  EXPECT_DOUBLE_EQ(is.sample, was.sample) << what;
  EXPECT_EQ(is.mode, was.mode) << what;
  EXPECT_EQ(is.entry, was.entry) << what;
  ASSERT_EQ(is.case_heading.has_value(), was.case_heading.has_value()) << what;
  EXPECT_NEAR(is.case_heading.value_or(0.0), was.case_heading.value_or(0.0), 1e-12) << what;
}

/// Extends a study by a position, reads it and looks whether the plan is the old one and that
/// position.
mc::Study extended_and_read(const mc::Study& before, const std::string& what) {
  mc::Study again = mc::read_study_text(extended_study(before, {added()}), "e.toml");
  EXPECT_EQ(again.plan.positions.size(), before.plan.positions.size() + 1) << what;
  EXPECT_EQ(again.plan.preset, "") << what;
  EXPECT_DOUBLE_EQ(again.plan.slew_rate, before.plan.slew_rate) << what;
  EXPECT_EQ(again.title, before.title) << what;
  if (again.plan.positions.size() != before.plan.positions.size() + 1) return again;
  for (std::size_t k = 0; k < before.plan.positions.size(); ++k)
    expect_position(again.plan.positions[k], before.plan.positions[k], what);
  expect_position(again.plan.positions.back(), added(), what);
  return again;
}

TEST(StudyWithPositions, IsThePlanAndThePositionAdded) {
  extended_and_read(study(preset), "preset");
  extended_and_read(study(listed), "listed");
  for (const std::string_view name : preset_names)
    extended_and_read(study("[plan]\npreset = \"" + std::string(name) +
                            "\"\ndwell = \"10 min\"\nsample = \"60 s\"\n"),
                      std::string(name));
}

TEST(StudyWithPositions, HoldsWhatTheCommandLineSet) {
  const mc::Study set = study(preset, "",
                              {{"plan.preset", "twelve"},
                               {"plan.dwell", "30 min"},
                               {"site.latitude", "48 deg"},
                               {"filter.f.coupling", "eq6"}});
  const mc::Study again = extended_and_read(set, "--set");
  EXPECT_EQ(again.plan.positions.size(), 13u);
  EXPECT_DOUBLE_EQ(again.plan.positions.front().dwell, 1800.0);
  EXPECT_DOUBLE_EQ(again.site.latitude, set.site.latitude);
  EXPECT_EQ(again.filters.front().coupling, Coupling::eq6);
}

std::vector<std::string> swept(const mc::Study& s) {
  std::vector<std::string> keys;
  for (const mc::SweepAxis& axis : s.sweep) keys.push_back(axis.key);
  return keys;
}

TEST(StudyWithPositions, SweepsNothingThatItsPositionsDecide) {
  using Keys = std::vector<std::string>;
  const mc::Study some = study(preset, R"([sweep]
"plan.preset" = ["six", "twelve"]
"readout.gimbal_noise" = ["5 arcsec", "10 arcsec"]
"plan.dwell" = ["10 min", "20 min"]
"plan.slew_rate" = ["0.25 deg/s", "0.5 deg/s"]
)");
  EXPECT_EQ(swept_of_plan(some), (Keys{"plan.preset", "plan.dwell"}));
  EXPECT_EQ(swept(extended_and_read(some, "some")),
            (Keys{"readout.gimbal_noise", "plan.slew_rate"}));

  const mc::Study table =
      study(preset, "[sweep]\nplan = [{ dwell = \"10 min\" }, { dwell = \"20 min\" }]\n");
  EXPECT_EQ(swept_of_plan(table), Keys{"plan"});
  EXPECT_TRUE(extended_and_read(table, "table").sweep.empty());

  // That of one position still changes it.
  const mc::Study tumble =
      study(listed,
            "[sweep]\n\"plan.position.mine.turn\" = [\"30 deg about y\", [\"30 deg about "
            "y\", \"5 deg about x\"]]\n");
  EXPECT_EQ(swept(extended_and_read(tumble, "tumble")), Keys{"plan.position.mine.turn"});
  const mc::Study one =
      study(listed, "[sweep]\n\"plan.position.mine.dwell\" = [\"10 min\", \"20 min\"]\n");
  EXPECT_EQ(swept_of_plan(one), Keys{});
  EXPECT_EQ(swept(extended_and_read(one, "one")), Keys{"plan.position.mine.dwell"});
  EXPECT_EQ(swept_of_plan(study(preset)), Keys{});
}

TEST(StudyWithPositions, OfAStrapdownTestIsRefused) {
  mc::Study s = study(preset);
  s.kind = RecordingKind::strapdown;
  EXPECT_THROW(extended_study(s, {added()}), InputError);
}

}  // namespace
}  // namespace drift::planning::study_with_positions_test
