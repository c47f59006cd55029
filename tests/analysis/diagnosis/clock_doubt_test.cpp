// A log whose times are all too long or too short, by a sample interval that was not what was
// written down, looks like a test at another latitude.
#include "analysis/identification/clock_doubt.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/diagnosis/site_doubt.hpp"
#include "analysis/identification/identify.hpp"
#include "analysis/report/diagnosis/doubts.hpp"
#include "analysis/report/diagnosis/report.hpp"
#include "analysis/report/diagnosis/sentence.hpp"
#include "tests/support/six_positions.hpp"

namespace drift::diagnosis::clock_doubt_test {
namespace {

/// Twelve slewed positions of 20 minutes at Harbin, logged with times `factor` times as long.
struct Scene {
  mc::Study study = test::six_study(1200.0, 60.0);
  Recording recording;

  explicit Scene(double factor) {
    PlanDefaults defaults;
    defaults.dwell = 1200.0;
    study.plan = preset_plan("slew12", defaults).value();
    recording = test::simulated(study);
    for (double& t : test::channel(recording, "time")) t *= factor;
  }
  std::optional<identification::LatitudeDoubt> doubt() const {
    return identification::latitude_doubt(study, {recording}, study.filters.front());
  }
};

TEST(ClockDoubt, TimesAreToldWhereTheyExplainWhatAnotherLatitudeWould) {
  for (const double factor : {1.01, 0.99}) {
    const auto doubt = Scene(factor).doubt();
    ASSERT_TRUE(doubt) << factor;
    ASSERT_TRUE(doubt->clock) << factor;
    EXPECT_LT(doubt->clock->sigma, 1e-4);
    EXPECT_NEAR(doubt->clock->factor, 1.0 / factor, 4.0 * doubt->clock->sigma) << factor;
    EXPECT_LT(doubt->clock->chi2_per_dof_after, 1.2);
    EXPECT_GT(doubt->clock->chi2_per_dof_before, 2.0);

    Diagnosis told;
    told.verdict = Verdict::unexplained;
    told.site_doubt = doubt;
    const report::InBrief brief = report::diagnosis_in_brief(told);
    EXPECT_EQ(brief.verdict.find("Verdict wrong times: The times of the recording"), 0u)
        << brief.verdict;
    EXPECT_NE(brief.next.find("multiply the times by"), std::string::npos) << brief.next;
    const auto json = nlohmann::json::parse(report::to_json(told));
    EXPECT_TRUE(json["latitude"].is_null());
    EXPECT_NEAR(json["clock"]["factor"].get<double>(), doubt->clock->factor, 1e-12);
  }
}

TEST(ClockDoubt, AnotherLatitudeIsNoClock) {
  Scene s(1.0);
  s.study.site.latitude +=
      0.55 * unit::deg.to_si;  // what a clock of one part in a hundred looks like
  const auto doubt = s.doubt();
  ASSERT_TRUE(doubt);
  EXPECT_NEAR(doubt->latitude, test::harbin.latitude, 5.0 * doubt->sigma);
  EXPECT_FALSE(doubt->clock);
}

TEST(ClockDoubt, WhereNothingIsCommandedItIsTheLatitudeOrTheClock) {
  // Twelve free positions: the Earth's rate about Up is isotropic D_I, that about North is both.
  Scene s(1.0);
  PlanDefaults defaults;
  defaults.dwell = 1200.0;
  s.study.plan = preset_plan("twelve", defaults).value();
  s.recording = test::simulated(s.study);
  for (double& t : test::channel(s.recording, "time")) t *= 1.002;
  const auto doubt = s.doubt();
  ASSERT_TRUE(doubt);
  EXPECT_FALSE(doubt->clock);
  ASSERT_TRUE(doubt->or_clock);
  EXPECT_NEAR(doubt->or_clock->factor, 1.0 / 1.002, 4.0 * doubt->or_clock->sigma);
  EXPECT_LT(doubt->or_clock->sigma, 1e-4);
  Diagnosis told;
  told.verdict = Verdict::unexplained;
  told.site_doubt = doubt;
  const report::InBrief brief = report::diagnosis_in_brief(told);
  EXPECT_EQ(brief.verdict.find("Verdict wrong latitude or times: "), 0u) << brief.verdict;
  EXPECT_NE(brief.next.find("the sample interval of the log"), std::string::npos) << brief.next;
  EXPECT_EQ(brief.next.find("--set site.latitude"), std::string::npos) << brief.next;
}

TEST(ClockDoubt, IdentifySaysItToo) {
  const Scene s(1.01);
  const auto id = identification::identify_recordings(s.study, {s.recording}, 1);
  ASSERT_TRUE(id.summaries.front().latitude_doubt);
  EXPECT_TRUE(id.summaries.front().latitude_doubt->clock);
}

}  // namespace
}  // namespace drift::diagnosis::clock_doubt_test
