#include "analysis/preparation/gimbal_zero.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/off_zero.hpp"
#include "tests/support/program.hpp"

namespace drift::preparation::gimbal_zero_test {
namespace {

/// What is said of a platform of which one gimbal reads so many degrees too much.
std::string said(int gimbal, double deg, std::string_view preset = "twentyfour",
                 std::uint64_t run = 0) {
  constexpr const char* names[] = {"gimbal_outer", "gimbal_middle", "gimbal_inner"};
  PlanDefaults defaults;
  defaults.mode = CommandLaw::free;
  defaults.dwell = 600.0;
  const mc::Study s = test::study_off_zero(preset, defaults);
  return gimbal_off_zero(s, test::recording_off_zero(s, names[gimbal], deg, run));
}

TEST(GimbalZero, AGimbalThatReadsADegreeTooMuchOrTooLittleIsNamedWithIt) {
  constexpr const char* names[] = {"gimbal_outer", "gimbal_middle", "gimbal_inner"};
  for (int gimbal = 0; gimbal < 3; ++gimbal)
    for (const double deg : {0.4, 1.0, -3.0}) {
      const std::string text = said(gimbal, deg);
      EXPECT_EQ(text.find(fmt::format("rec.csv:{}: it reads ", names[gimbal])), 0u) << text;
      const std::string key = fmt::format("offset = {{ {} = \"", names[gimbal]);
      const auto at = text.find(key);
      ASSERT_NE(at, std::string::npos) << text;
      // Biases and misalignments of the accelerometers make 0.06 deg of it, 1 sigma.
      EXPECT_NEAR(std::stod(text.substr(at + key.size())), -deg, 3.0 * 0.06) << text;
      EXPECT_NE(text.find(deg > 0.0 ? "deg too much" : "deg too little"), std::string::npos);
    }
}

TEST(GimbalZero, NoneIsNamedOfSoundPlatformsNorWherePriorsMayMakeIt) {
  for (const char* preset : {"six", "twentyfour", "slew12"})
    for (std::uint64_t run = 0; run < 20; ++run) EXPECT_EQ(said(0, 0.0, preset, run), "") << preset;
  for (int gimbal = 0; gimbal < 3; ++gimbal) EXPECT_EQ(said(gimbal, 0.2), "") << gimbal;
}

TEST(GimbalZero, AGimbalThatTurnsTheOtherWayIsNamedWhereThePlanDoesNotShowIt) {
  constexpr const char* names[] = {"gimbal_outer", "gimbal_middle", "gimbal_inner"};
  PlanDefaults defaults;
  defaults.mode = CommandLaw::free;
  defaults.dwell = 2400.0;
  for (const char* preset : {"six", "twelve"}) {
    const mc::Study s = test::study_off_zero(preset, defaults);
    for (std::uint64_t run = 0; run < 5; ++run) {
      const Recording sound = test::recording_off_zero(s, "gimbal_middle", 0.0, run);
      EXPECT_EQ(gimbal_of_wrong_sign(s, sound), "") << preset;
      Recording r = sound;
      for (Channel& c : r.channels)
        if (c.name == "gimbal_middle")
          for (double& angle : c.values) angle = -angle;
      const std::string text = gimbal_of_wrong_sign(s, r);
      EXPECT_NE(text.find("column gimbal_middle: the sign is wrong"), std::string::npos)
          << preset << text;
      EXPECT_NE(text.find("columns = { gimbal_middle = \"-gimbal_middle\" }"), std::string::npos)
          << text;
    }
    for (const char* name : names)  // a zero is no sign
      EXPECT_EQ(gimbal_of_wrong_sign(s, test::recording_off_zero(s, name, 3.0, 0)), "") << name;
  }
}

TEST(GimbalSign, IsToldByAFewMinutesInWhichThePlatformTurns) {
  // Five minutes turn the middle gimbal by a degree: Up by both differs by 0.1 deg rms, twice what
  // biases and misalignments make of it, and by 0.013 deg within the positions, where the noise of
  // 5 arcsec makes 0.0015 deg: 3 * 0.11^11 = 1e-10.
  PlanDefaults defaults;
  defaults.mode = CommandLaw::free;
  defaults.dwell = 300.0;
  const mc::Study s = test::study_off_zero("six", defaults);
  for (std::uint64_t run = 0; run < 5; ++run) {
    Recording r = test::recording_off_zero(s, "gimbal_middle", 0.0, run);
    EXPECT_EQ(gimbal_of_wrong_sign(s, r), "") << run;
    for (const char* name : {"gimbal_outer", "gimbal_middle", "gimbal_inner"})  // a zero is no sign
      EXPECT_EQ(gimbal_of_wrong_sign(s, test::recording_off_zero(s, name, 0.2, run)), "") << name;
    for (Channel& c : r.channels)
      if (c.name == "gimbal_middle")
        for (double& angle : c.values) angle = -angle;
    const std::string text = gimbal_of_wrong_sign(s, r);
    EXPECT_NE(text.find("column gimbal_middle: the sign is wrong"), std::string::npos) << run;
    EXPECT_NE(text.find("but for a constant in each position"), std::string::npos) << text;
  }
}

TEST(GimbalZero, IsSaidFirstInTheShortAnswerOfIdentify) {
  const test::ScratchFolder folder;
  std::string study =
      test::text_of(std::string(DRIFT_SOURCE_DIR) + "/configs/diagnose_equation.toml");
  const std::string args =
      " --set plan.dwell=\"10 min\" --set filter.nominal.coupling=eq5 --progress none ";
  const std::string config = "'" + folder.write("s.toml", study) + "'";
  const std::string sound = folder.file("sound.csv"), log = folder.file("log.csv");
  ASSERT_EQ(
      test::driftscope("simulate " + config + " --set plan.dwell=\"10 min\" -o " + sound).code, 0);
  Recording r = read_recording(sound, RecordingKind::platform, 9.80665);
  for (Channel& c : r.channels)
    if (c.name == "gimbal_middle")
      for (double& angle : c.values) angle += detail::deg;
  write_recording(r, log);
  const test::Answer a = test::driftscope("identify " + config + " " + log + args);
  ASSERT_EQ(a.code, 0) << a.err;
  EXPECT_NE(a.out.find("\nGimbals:"), std::string::npos) << a.out;
  EXPECT_LT(a.out.find("\nGimbals:"), a.out.find("\nNext:")) << a.out;
  EXPECT_NE(a.out.find("Next: correct the zero, or its offset"), std::string::npos) << a.out;
  EXPECT_EQ(test::driftscope("identify " + config + " " + sound + args).out.find("Gimbals:"),
            std::string::npos);
}

}  // namespace
}  // namespace drift::preparation::gimbal_zero_test
