#include "analysis/identification/heading_doubt.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/diagnosis/diagnose_recordings.hpp"
#include "analysis/identification/identify.hpp"
#include "analysis/preparation/prepare.hpp"
#include "analysis/report/diagnosis/report.hpp"
#include "analysis/report/identify/report.hpp"
#include "analysis/report/identify/turned_words.hpp"
#include "tests/support/six_positions.hpp"

namespace drift::heading_doubt_test {
namespace {

/// Six caged positions, and a study that may say other headings.
struct Scene : test::SixWithHidden {
  explicit Scene(CommandLaw law = CommandLaw::free, double hidden = 0.0)
      : SixWithHidden(law, hidden) {}

  /// The log has no such columns.
  void leave_out(std::string_view begin) {
    std::erase_if(recording.channels, [&](const Channel& c) { return c.name.starts_with(begin); });
  }

  /// The study says that the case stood at another heading, and all that follows from it.
  void turn(std::size_t position, double deg) {
    Position& p = study.plan.positions[position];
    p.R_lp = case_attitude(deg * detail::deg) * p.R_lp;
    p.case_heading = p.case_heading.value_or(0.0) + deg * detail::deg;
  }
  void turn_all(double deg) {
    for (std::size_t p = 0; p < study.plan.positions.size(); ++p) turn(p, deg);
  }
  /// The headings of six, which the plan leaves open.
  void write_headings() {
    const Timeline timeline = lay_out(preset_plan("six", {}).value(), study.site);
    for (const Interval& i : timeline.intervals)
      study.plan.positions[static_cast<std::size_t>(i.position)].case_heading = i.heading1;
  }

  std::optional<identification::HeadingDoubt> doubt() const {
    return identification::heading_doubt(study, {recording}, study.filters.front());
  }
};

TEST(HeadingDoubt, FindsTheTurnOfAPlanWhoseCaseHeadedOtherwise) {
  for (const double off : {45.0, -90.0, 180.0}) {
    Scene s;
    const std::vector<Position> right = s.study.plan.positions;
    s.leave_out("case_heading");
    s.write_headings();
    s.turn_all(off);
    const auto doubt = s.doubt();
    ASSERT_TRUE(doubt) << off;
    EXPECT_TRUE(doubt->all_alike);
    ASSERT_EQ(doubt->turned.size(), 6u);
    EXPECT_NEAR(std::cos(doubt->turned.front().turn + off * detail::deg), 1.0, 1e-9) << off;
    for (std::size_t p = 0; p < 6; ++p) EXPECT_EQ(doubt->positions[p].axes, right[p].axes) << off;
    EXPECT_NEAR(doubt->chi2_per_dof_after, 1.0, 0.2);
    EXPECT_TRUE(doubt->alone());
    EXPECT_LT(doubt->chance, 1e-9);
    s.study.plan.positions = doubt->positions;
    EXPECT_FALSE(s.doubt()) << "the corrected plan is right";
  }
}

TEST(HeadingDoubt, FindsThePositionsThatAreTurnedByThemselvesWithEitherInstrument) {
  for (const std::string_view absent : {"gimbal_", "acc_"}) {
    Scene s;
    const std::vector<Position> right = s.study.plan.positions;
    s.leave_out(absent);
    s.leave_out("case_heading");
    s.write_headings();
    s.turn(1, 45.0);
    s.turn(3, -90.0);
    const auto doubt = s.doubt();
    ASSERT_TRUE(doubt) << absent;
    EXPECT_FALSE(doubt->all_alike);
    ASSERT_EQ(doubt->turned.size(), 2u) << absent;
    EXPECT_EQ(doubt->turned[0].position, 1);
    EXPECT_NEAR(doubt->turned[0].turn, -45.0 * detail::deg, 1e-12);
    EXPECT_EQ(doubt->turned[1].position, 3);
    EXPECT_NEAR(doubt->turned[1].turn, 90.0 * detail::deg, 1e-12);
    for (std::size_t p = 0; p < 6; ++p) EXPECT_EQ(doubt->positions[p].axes, right[p].axes);
  }
}

TEST(HeadingDoubt, TheCommandsOfALevelPlanShowNorthToo) {
  Scene s(CommandLaw::level);
  s.leave_out("case_heading");
  s.write_headings();
  s.turn(2, 135.0);
  const auto doubt = s.doubt();
  ASSERT_TRUE(doubt);
  ASSERT_EQ(doubt->turned.size(), 1u);
  EXPECT_NEAR(doubt->turned.front().turn, -135.0 * detail::deg, 1e-12);
}

TEST(HeadingDoubt, ARecordedHeadingThatIsWrongInTheSameWayIsTurnedBack) {
  Scene s;
  s.write_headings();
  s.turn_all(45.0);
  for (Channel& c : s.recording.channels)
    if (c.name == "case_heading")
      for (double& value : c.values) value += 45.0 * detail::deg;
  const auto doubt = s.doubt();
  ASSERT_TRUE(doubt);
  EXPECT_TRUE(doubt->alone());
  EXPECT_TRUE(doubt->recorded);
  // What corrected.toml says is refused beside it.
  EXPECT_NE(report::corrected_text(*doubt, "diagnose").find("recording.ignore=[\"case_heading\"]"),
            std::string::npos);
}

TEST(HeadingDoubt, IsNotRaisedOfARightPlanWhateverElseMisfits) {
  EXPECT_FALSE(Scene().doubt());
  EXPECT_FALSE(Scene(CommandLaw::level).doubt());
  EXPECT_FALSE(Scene(CommandLaw::free, 3.0).doubt());
  Scene elsewhere;
  elsewhere.study.site.latitude = -30.0 * detail::deg;
  EXPECT_FALSE(elsewhere.doubt());
}

TEST(HeadingDoubt, IsTheFirstThingThatBothCommandsSayAndLeavesThePlanToGoOnWith) {
  Scene s(CommandLaw::free, 0.3);
  s.leave_out("case_heading");
  s.write_headings();
  s.turn(4, 90.0);
  diagnosis::RecordingsOptions options;
  options.diagnose.starts = 1;
  options.diagnose.whiteness_draws = 0;
  const diagnosis::Diagnosis d = diagnosis::diagnose_recordings(s.study, {s.recording}, options);
  ASSERT_TRUE(d.heading_doubt);
  EXPECT_FALSE(d.heading_doubt->alone()) << d.heading_doubt->chance_after;
  const report::InBrief brief = report::diagnosis_in_brief(d);
  EXPECT_EQ(brief.verdict.find("Verdict wrong headings and more: The platform did not head as the "
                               "plan says, but turned about Up by 90 deg, from North toward East, "
                               "in position 5"),
            0u)
      << brief.verdict;
  EXPECT_NE(brief.next.find("corrected.toml"), std::string::npos) << brief.next;
  EXPECT_EQ(brief.next.find("case_heading"), std::string::npos) << brief.next;
  EXPECT_EQ(nlohmann::json::parse(report::to_json(d))["heading"]["turned"][0]["position"], 5);

  const auto id = identification::identify_recordings(s.study, {s.recording}, 1);
  ASSERT_TRUE(id.summaries.front().heading_doubt);
  EXPECT_FALSE(id.summaries.front().latitude_doubt);
  const report::Report said = report::identification_report(s.study, id);
  EXPECT_EQ(said.brief.verdict.find("Misfit: The platform did not head as the plan says"), 0u)
      << said.brief.verdict;
  EXPECT_NE(said.brief.next.find("corrected.toml"), std::string::npos) << said.brief.next;
}

TEST(HeadingDoubt, PositionsOfOtherHeadingsAreNotTakenForAPlatformThatStands) {
  // Seen by accelerometers alone, the turns of positions that head every way are none in the mean.
  Scene s;
  s.leave_out("gimbal_");
  s.leave_out("case_heading");
  s.leave_out("cmd_");
  s.write_headings();
  for (const std::size_t p : {1u, 3u, 5u}) s.turn(p, 180.0);
  EXPECT_NO_THROW(preparation::prepare(s.study, {s.recording}));
  EXPECT_TRUE(s.doubt());
}

}  // namespace
}  // namespace drift::heading_doubt_test
