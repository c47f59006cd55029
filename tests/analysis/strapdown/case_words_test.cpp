// What the answer says of a fit that nothing could be held out of.
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "analysis/report/strapdown/case_report.hpp"
#include "analysis/strapdown/case_identify.hpp"
#include "tests/support/strapdown_recording.hpp"

namespace drift::strapdown::case_words_test {
namespace {

mc::Study of_twelve_dwells() {
  return mc::read_study_text(test::strapdown_study("45.75 deg", "9.8 m/s^2"), "study.toml");
}

/// A unit without errors, held twelve times.
CaseIdentification identified(const mc::Study& study) {
  test::StrapdownScript script;
  script.dwells = 12;
  script.omega_ie_l = study.site.omega_ie_l();
  return identify_case(study, case_study(study, strapdown_recording(script, Theta::Zero())));
}

TEST(CaseWords, WhatHasNoNumberIsNotSaid) {
  const mc::Study study = of_twelve_dwells();
  CaseIdentification id = identified(study);
  const auto said = [&] {
    return fmt::format("{}", fmt::join(report::case_report(study, id).brief.more.texts(), "\n"));
  };
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  ASSERT_GT(id.fits.front().up.count, 0u);
  EXPECT_NE(said().find("Up after a turn that was held out: "), std::string::npos) << said();
  EXPECT_NE(said().find("; gyros in dwells held out: "), std::string::npos) << said();
  id.fits.front().up.held_out = none;
  EXPECT_EQ(said().find("Up after a turn"), std::string::npos) << said();
  EXPECT_NE(said().find("Gyros in dwells held out: "), std::string::npos) << said();
  id.fits.front().gyro.held_out = none;
  EXPECT_EQ(said().find("held out"), std::string::npos) << said();
  EXPECT_EQ(said().find("- deg"), std::string::npos) << said();
}

/// One per cent more of g than there is: identify says it, as diagnose does.
TEST(CaseWords, AGravityThatIsOffIsSaidByBothCommands) {
  const mc::Study study =
      mc::read_study_text(test::strapdown_study("45.75 deg", "9.8 m/s^2"), "study.toml");
  test::StrapdownScript script;
  script.dwells = 16;
  script.rest = 10.0;
  script.turn = 8.0;
  script.gyro_noise = 3e-6;
  script.acc_noise = 1e-4;
  script.omega_ie_l = study.site.omega_ie_l();
  const Recording right = strapdown_recording(script, Theta::Zero());
  Recording wrong = right;
  for (Channel& c : wrong.channels)
    if (c.name.starts_with("acc_"))
      for (double& force : c.values) force *= 1.01;
  const auto brief_of = [&](const Recording& r) {
    return report::case_report(study, identify_case(study, case_study(study, r))).brief;
  };
  const auto said = [](const report::InBrief& brief) {
    return fmt::format("{}\n{}\n{}", brief.verdict, fmt::join(brief.more.texts(), "\n"),
                       brief.next);
  };
  EXPECT_EQ(said(brief_of(right)).find("ravity"), std::string::npos) << said(brief_of(right));
  const report::InBrief brief = brief_of(wrong);
  for (const char* words :
       {"Gravity: K1_x, K1_y and K1_z are larger alike: of readings in m/s^2 a site.gravity that "
        "is",
        "Next: correct site.gravity, or the unit of the accelerometers, and identify again."})
    EXPECT_NE(said(brief).find(words), std::string::npos) << said(brief);
  EXPECT_EQ(brief.verdict.find("something is missing"), std::string::npos) << said(brief);
}

/// Noise that nothing explains is a misfit whatever the gravity: it is not of priors alone.
TEST(CaseWords, AMisfitBesideAGravityThatIsOffStaysOne) {
  const mc::Study study = of_twelve_dwells();
  CaseIdentification id = identified(study);
  EstimateResult& estimate = id.fits.front().fit.estimate;
  for (ParameterEstimate& p : estimate.parameters)
    if (TermLibrary::specs[p.param].group.view() == "K1")
      p.value = p.prior_mean + 20.0 * p.prior_sigma;
  const double fits = static_cast<double>(estimate.measured);
  estimate.statistic = fits + 1200.0;
  EXPECT_TRUE(report::case_report(study, id).brief.verdict.starts_with("Misfit of priors alone"))
      << report::case_report(study, id).brief.verdict;
  estimate.statistic = 5.0 * fits + 1200.0;
  const report::InBrief brief = report::case_report(study, id).brief;
  EXPECT_TRUE(brief.verdict.starts_with("Misfit: ")) << brief.verdict;
  EXPECT_NE(brief.next.find("driftscope diagnose"), std::string::npos) << brief.next;
  EXPECT_TRUE(std::ranges::any_of(
      brief.more.texts(), [](const std::string& text) { return text.starts_with("Gravity: "); }));
}

}  // namespace
}  // namespace drift::strapdown::case_words_test
