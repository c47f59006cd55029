// The heading of the case is recorded by another device than the gimbals: its zero may be off.
#include "analysis/preparation/heading_zero.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace
}  // namespace drift::preparation::heading_zero_test
