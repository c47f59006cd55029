// A clock that is off turns a case by more than it was turned, about all axes alike: so do three
// gyros whose scale factors are bent alike, and no such cause is named alone.
#include "analysis/strapdown/case_times.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/report/diagnosis/report.hpp"
#include "analysis/report/diagnosis/words/sentence.hpp"
#include "analysis/strapdown/case_diagnose.hpp"
#include "core/config/load.hpp"
#include "tests/support/case_unit.hpp"
#include "tests/support/recordings_by_others.hpp"

namespace drift::strapdown::case_times_test {
namespace {

using diagnosis::Diagnosis;
using diagnosis::Verdict;
using diagnosis::remark::TimesInstead;

Diagnosis diagnosed(const mc::Study& study, Recording recording, double factor) {
  for (Channel& channel : recording.channels)
    if (channel.name == "time")
      for (double& t : channel.values) t *= factor;
  return diagnose_case(study, identify_case(study, recording));
}

mc::Study study_of_units() {
  return mc::read_study_text(
      test::strapdown_study(fmt::format("{} deg", case_unit::site.latitude / unit::deg.to_si),
                            "9.8 m/s^2"),
      "study.toml");
}

void expect_times(const Diagnosis& d, double factor) {
  SCOPED_TRACE(report::sentence(d));
  ASSERT_NE(d.verdict, Verdict::consistent);
  EXPECT_NE(d.verdict, Verdict::named);
  const auto* times = diagnosis::remark_in<TimesInstead>(d);
  ASSERT_NE(times, nullptr);
  EXPECT_NEAR(times->clock.factor, 1.0 / factor, 4.0 * times->clock.sigma);
  EXPECT_LT(times->clock.sigma, 5e-4);
  const report::InBrief brief = report::diagnosis_in_brief(d);
  EXPECT_NE(brief.next.find("look up the sample interval of the log"), std::string::npos)
      << brief.next;
  EXPECT_NE(brief.next.find(factor > 1.0 ? "too long" : "too short"), std::string::npos)
      << "what the verdict says of it may have no room: " << brief.next;
  EXPECT_NE(report::brief_text(brief, 80).find("the sample interval"), std::string::npos);
  const auto json = nlohmann::json::parse(report::to_json(d));
  EXPECT_NEAR(json["or_times"]["factor"].get<double>(), times->clock.factor, 1e-12);
}

TEST(CaseTimes, AClockThatIsOffIsToldWithWhatIsFoundForIt) {
  const mc::Study study = study_of_units();
  const Recording recording = strapdown_recording(case_unit::script(73), case_unit::sensors());
  for (const double factor : {1.005, 0.995})
    expect_times(diagnosed(study, recording, factor), factor);
  const Diagnosis right = diagnosed(study, recording, 1.0);
  EXPECT_EQ(right.verdict, Verdict::consistent) << report::sentence(right);
  EXPECT_EQ(diagnosis::remark_in<TimesInstead>(right), nullptr);
}

/// An asymmetry of one gyro is no clock.
TEST(CaseTimes, WhatOneGyroDoesIsNamedAlone) {
  Theta theta = case_unit::sensors();
  test::set(theta, "s_a_y", 100.0);
  const Diagnosis d =
      diagnosed(study_of_units(), strapdown_recording(case_unit::script(74), theta), 1.0);
  ASSERT_NE(d.verdict, Verdict::consistent);
  EXPECT_EQ(diagnosis::remark_in<TimesInstead>(d), nullptr) << report::sentence(d);
}

TEST(CaseTimes, OfPsinsAtTwoPerMilleNonlinearityIsNotNamedAlone) {
  NEEDS_RECORDING("psins19.csv");
  const mc::Study study = mc::read_study(DRIFT_SOURCE_DIR "/configs/strapdown_psins.toml");
  const Recording recording =
      read_recording(test::path_of("psins19.csv"), RecordingKind::strapdown, study.site.gravity);
  for (const double factor : {1.002, 0.995})
    expect_times(diagnosed(study, recording, factor), factor);
}

/// The verdict says both in one sentence, and the clock is not said again below it.
TEST(CaseTimes, TheVerdictSaysTheCauseOrTheTimes) {
  Diagnosis d;
  d.of_case = true;
  d.verdict = Verdict::ambiguous;
  d.causes.emplace_back().term = "torquer_nonlinearity";
  d.remarks = {TimesInstead{{1.0 / 1.002, 1.3e-4, 1.10, 1.0}, 3.0}};
  const report::InBrief brief = report::diagnosis_in_brief(d);
  EXPECT_NE(brief.verdict.find("it may be scale factor nonlinearity"), std::string::npos)
      << brief.verdict;
  EXPECT_NE(brief.verdict.find(", but times (the clock of the log) that are all 0.2 % too long "
                               "would leave as little"),
            std::string::npos)
      << brief.verdict;
  EXPECT_EQ(brief.verdict.find("likelier"), std::string::npos) << brief.verdict;
  EXPECT_EQ(report::brief_text(brief, 80).find("Clock:"), std::string::npos);
  EXPECT_NE(brief.next.find("before anything is added to the model"), std::string::npos)
      << brief.next;
  EXPECT_EQ(nlohmann::json::parse(report::to_json(d))["or_times"]["odds"].get<double>(), 3.0);
  d.remarks = {TimesInstead{{1.0 / 1.002, 1.3e-4, 1.10, 1.0}, 100.0}};
  EXPECT_NE(report::sentence(d).find("would leave as little and are far likelier (every time"),
            std::string::npos)
      << report::sentence(d);
}

}  // namespace
}  // namespace drift::strapdown::case_times_test
