// What the answer says of a fit that nothing could be held out of.
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <limits>

#include "analysis/report/strapdown/case_report.hpp"
#include "analysis/strapdown/case_identify.hpp"
#include "tests/support/strapdown_recording.hpp"

namespace drift::strapdown::case_words_test {
namespace {

TEST(CaseWords, WhatHasNoNumberIsNotSaid) {
  const mc::Study study =
      mc::read_study_text(test::strapdown_study("45.75 deg", "9.8 m/s^2"), "study.toml");
  test::StrapdownScript script;
  script.dwells = 12;
  script.omega_ie_l = study.site.omega_ie_l();
  CaseIdentification id =
      identify_case(study, case_study(study, strapdown_recording(script, Theta::Zero())));
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

}  // namespace
}  // namespace drift::strapdown::case_words_test
