// The heading of the case is recorded by another device than the gimbals: its zero may be off.
#include "analysis/preparation/heading_zero.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/plan/case_heading.hpp"
#include "tests/support/off_zero.hpp"

namespace drift::preparation::heading_zero_test {
namespace {

/// What is said of a platform whose heading reads so many degrees too much.
std::string said(double deg, std::string_view preset, std::uint64_t run = 0, double sample = 60.0) {
  PlanDefaults defaults;
  defaults.dwell = 600.0;
  defaults.sample = sample;
  const mc::Study s = test::study_off_zero(preset, defaults);
  return heading_off_zero(s, test::recording_off_zero(s, "case_heading", deg, run));
}

TEST(HeadingZero, IsFoundWhereThePlatformIsCagedWhateverItsDrift) {
  for (const char* preset : {"six", "twelve", "slew12"})
    for (const double deg : {1.0, -4.0, 9.0}) {
      const std::string text = said(deg, preset);
      EXPECT_EQ(text.find("rec.csv:case_heading: it reads "), 0u) << preset << " " << deg << text;
      EXPECT_NE(text.find(deg > 0.0 ? "deg too much" : "deg too little"), std::string::npos)
          << text;
      const std::string key = "offset = { case_heading = \"";
      const auto at = text.find(key);
      ASSERT_NE(at, std::string::npos) << text;
      // As well as caging is known: 4 sigma of the mean over six positions, or of one.
      const double positions = std::string_view(preset) == "slew12" ? 1.0 : 6.0;
      const double caging = test::base_filter(Coupling::eq5).initial_attitude / detail::deg;
      EXPECT_NEAR(std::stod(text.substr(at + key.size())), -deg,
                  4.0 * caging / std::sqrt(positions))
          << preset << text;
    }
}

TEST(HeadingZero, NoneIsSaidOfSoundPlatforms) {
  for (const char* preset : {"six", "twentyfour", "slew12"})
    for (std::uint64_t run = 0; run < 10; ++run)
      for (const double sample : {60.0, 120.0})
        EXPECT_EQ(said(0.0, preset, run, sample), "") << preset;
}

TEST(HeadingZero, OfOneCagedPositionTheInnerGimbalIsSaidToo) {
  EXPECT_NE(said(2.0, "slew12").find("An inner gimbal that reads as much too much"),
            std::string::npos);
  EXPECT_EQ(said(2.0, "six").find("An inner gimbal"), std::string::npos);
}

/// A platform whose case stood so many degrees further than its plan says, in a log without a
/// column of headings.
std::string said_without_column(double deg, std::uint64_t run = 0) {
  PlanDefaults defaults;
  defaults.dwell = 600.0;
  const mc::Study s = test::study_off_zero("six", defaults);
  mc::Study further = s;
  const std::vector<Passage> passages = plan_passages(s.plan, s.site);
  for (std::size_t p = 0; p < passages.size(); ++p)
    further.plan.positions[p].case_heading = passages[p].dwell.heading1 + deg * detail::deg;
  Recording r = test::recording_off_zero(further, "", 0.0, run);
  std::erase_if(r.channels, [](const Channel& c) { return c.name == "case_heading"; });
  return heading_off_zero(s, r);
}

TEST(HeadingZero, OfThePlanIsToldWhereNoneIsRecorded) {
  for (const double deg : {3.0, -4.0}) {
    const std::string text = said_without_column(deg);
    EXPECT_EQ(text.find("rec.csv: the case stood "), 0u) << deg << text;
    EXPECT_NE(text.find(deg > 0.0 ? "further from North over West" : "less far from North"),
              std::string::npos)
        << text;
    // The first heading of "six" is 0; caging makes 200 arcsec of it, 4 sigma of the mean of six.
    const std::string key = "[[plan.position]] (";
    const auto at = text.find(key);
    ASSERT_NE(at, std::string::npos) << text;
    const double caging = test::base_filter(Coupling::eq5).initial_attitude / detail::deg;
    EXPECT_NEAR(std::stod(text.substr(at + key.size())), deg, 4.0 * caging / std::sqrt(6.0))
        << text;
  }
  for (std::uint64_t run = 0; run < 10; ++run) EXPECT_EQ(said_without_column(0.0, run), "");
}

}  // namespace
}  // namespace drift::preparation::heading_zero_test
