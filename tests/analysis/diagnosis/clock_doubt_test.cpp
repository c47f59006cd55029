// A log whose times are all too long or too short, by a sample interval that was not what was
// written down, looks like a test at another latitude.
#include "analysis/identification/clock_doubt.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/diagnosis/diagnose_recordings.hpp"
#include "analysis/diagnosis/doubts/site_doubt.hpp"
#include "analysis/identification/identify.hpp"
#include "analysis/report/diagnosis/report.hpp"
#include "analysis/report/diagnosis/words/doubts.hpp"
#include "analysis/report/diagnosis/words/remark_words.hpp"
#include "analysis/report/diagnosis/words/sentence.hpp"
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

/// Twelve free positions of 40 minutes, logged with times `factor` times as long.
struct Free : Scene {
  explicit Free(double factor) : Scene(1.0) {
    PlanDefaults defaults;
    defaults.dwell = 2400.0;
    study.plan = preset_plan("twelve", defaults).value();
    recording = test::simulated(study);
    for (double& t : test::channel(recording, "time")) t *= factor;
  }
  Diagnosis diagnosed() const {
    RecordingsOptions options;
    options.diagnose.starts = 1;
    options.diagnose.whiteness_draws = 0;
    options.advising = Advising::left_out;
    return diagnose_recordings(study, {recording}, options);
  }
};

TEST(ClockDoubt, ASmallErrorOfTheClockIsToldWithTheCauseThatIsNamedForIt) {
  // 250 ppm are 50 arcsec of latitude here, 2.5 times what is usual: no survey is doubted for it.
  const Free s(1.00025);
  const Diagnosis d = s.diagnosed();
  ASSERT_FALSE(d.site_doubt || d.other_latitude) << report::sentence(d);
  ASSERT_FALSE(d.causes.empty()) << report::sentence(d);
  const auto* times = remark_in<remark::TimesInstead>(d);
  ASSERT_NE(times, nullptr) << report::sentence(d);
  EXPECT_LT(times->clock.sigma, 5e-5);
  EXPECT_NEAR(times->clock.factor, 1.0 / 1.00025, 4.0 * times->clock.sigma);
  const report::InBrief brief = report::diagnosis_in_brief(d);
  EXPECT_NE(brief.verdict.find("Times that are all too long would leave the same"),
            std::string::npos)
      << brief.verdict;
  const std::string shown = report::brief_text(brief, 80);
  EXPECT_NE(shown.find("Times that are all too"), std::string::npos) << shown;
  if (d.verdict == Verdict::named) {
    EXPECT_NE(brief.next.find("look up the sample interval of the log"), std::string::npos)
        << brief.next;
  }
  const auto json = nlohmann::json::parse(report::to_json(d));
  EXPECT_NEAR(json["or_times"]["factor"].get<double>(), times->clock.factor, 1e-12);
  EXPECT_NE(json["remarks"].dump().find("the nominal model fits by itself"), std::string::npos);
}

TEST(ClockDoubt, NothingIsSaidOfTheClockWhereNothingIsMissing) {
  const Diagnosis d = Free(1.0).diagnosed();
  ASSERT_EQ(d.verdict, Verdict::consistent) << report::sentence(d);
  EXPECT_EQ(remark_in<remark::TimesInstead>(d), nullptr);
  EXPECT_TRUE(nlohmann::json::parse(report::to_json(d))["or_times"].is_null());
}

TEST(ClockDoubt, ACauseThatLeavesLessThanTheClockStandsAlone) {
  const Free s(1.00025);
  Diagnosis d;
  d.nominal = d.patched = s.study.filters.front();
  d.verdict = Verdict::named;
  d.causes.emplace_back().term = "latitude_error";
  d.patched.active |= test::only({"d_lat"});
  d.fit.dof = 2880;
  const auto clock =
      identification::clock_of_misfit(s.study, {s.recording}, d.nominal, 0.0).value();
  EXPECT_TRUE(clock.evident());
  d.fit.chi2_per_dof_before = clock.chi2_per_dof_before;
  // One parameter takes up 1 + 5 sqrt(2) of chi-square by chance, with 6e-7 (FitLimits::misfit).
  for (const auto& [less, told] : {std::pair{0.0, true}, {7.0, true}, {9.0, false}}) {
    d.fit.chi2_per_dof_after = clock.chi2_per_dof_after - less / 2880.0;
    EXPECT_EQ(times_instead(s.study, {s.recording}, d).has_value(), told) << less;
  }
  // What the clock promises is less than half of what the cause gains.
  d.fit.chi2_per_dof_before += 10.0;
  EXPECT_FALSE(times_instead(s.study, {s.recording}, d));
  d.fit.chi2_per_dof_before -= 10.0;
  d.fit.chi2_per_dof_after = clock.chi2_per_dof_after;
  d.verdict = Verdict::consistent;
  EXPECT_FALSE(times_instead(s.study, {s.recording}, d));
}

TEST(ClockDoubt, IsEvidentWhereItsEvidenceExceedsTheRarityOfOtherTimes) {
  // 1000 to 1 against, and of every factor from a half to twice one is looked at: a gain of
  // 2 log(1000 x 2 log 2 / (sqrt(2 pi) 1e-5)) = 35.7.
  identification::ClockDoubt clock{1.0, 1e-5};
  clock.weigh(35.5);
  EXPECT_FALSE(clock.evident());
  clock.weigh(35.8);
  EXPECT_TRUE(clock.evident());
}

TEST(ClockDoubt, IsToldInOneSentenceWithAnotherLatitude) {
  Diagnosis d;
  d.verdict = Verdict::named;
  d.causes.emplace_back().term = "magnetic_drift";
  d.other_latitude.emplace();
  d.remarks = {remark::TimesInstead{{1.0004, 1e-5, 1.46, 1.04}}};
  EXPECT_NE(report::sentence(d).find("and so would times that are all 1.000400±0.000010 times as "
                                     "long: check the latitude of [site] on a map and the clock"),
            std::string::npos)
      << report::sentence(d);
  EXPECT_EQ(report::in_words(d.remarks.front()).find("Times that are all too short"), 0u)
      << report::in_words(d.remarks.front());
}

TEST(ClockDoubt, IdentifySaysItToo) {
  const Scene s(1.01);
  const auto id = identification::identify_recordings(s.study, {s.recording}, 1);
  ASSERT_TRUE(id.summaries.front().latitude_doubt);
  EXPECT_TRUE(id.summaries.front().latitude_doubt->clock);
}

}  // namespace
}  // namespace drift::diagnosis::clock_doubt_test
