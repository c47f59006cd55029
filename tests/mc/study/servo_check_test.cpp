// Loops of [truth.servo] that do not settle.
#include "mc/study/servo_check.hpp"

#include <gtest/gtest.h>

#include "mc/study/sweep.hpp"
#include "tests/mc/small_study.hpp"
#include "tests/mc/study/study_file.hpp"

namespace drift::servo_check_test {
namespace {

const mc::Overrides servo = {{"truth.coupling", "servo"}};

std::vector<std::string> with(const std::string& table) {
  return test::mistakes(test::small_study + "[truth.servo]\n" + table, servo);
}
bool says(const std::vector<std::string>& found, const std::string& text) {
  return found.size() == 1 && found[0].find(text) != std::string::npos;
}

TEST(ServoCheck, TheDefaultLoopAndItsNeighboursPass) {
  EXPECT_TRUE(test::mistakes(test::small_study, servo).empty());
  for (const char* table :
       {"loop_gain = \"20 N*m/rad\"", "loop_gain = \"400 N*m/rad\"",
        "float_restraint = \"0.1 N*m/rad\"",
        "motor_coupling = [[1, 0.1, 0], [-0.1, 1, 0], [0, 0, 0.9]]", "coulomb = \"0.01 N*m\""})
    EXPECT_TRUE(with(table).empty()) << table;
}

TEST(ServoCheck, AnUnstableLoopIsRefusedWithItsGrowth) {
  for (const char* table : {"lead = \"0.0021 s\"", "lead = \"0 s\"", "loop_gain = \"1e9 N*m/rad\"",
                            "motor_coupling = [[-1, 0, 0], [0, 1, 0], [0, 0, 1]]"})
    EXPECT_TRUE(says(with(table), "'truth.servo' makes an unstable loop")) << table;
  EXPECT_TRUE(says(with("lead = \"0 s\""), ", swinging at 9.96 Hz (expected"));
  // Aligned gyros do not turn one axis into the other: it settles, though in minutes.
  mc::Overrides aligned = servo;
  aligned.emplace_back("truth.terms", "[\"fixed_drift\"]");
  EXPECT_TRUE(
      test::mistakes(test::small_study + "[truth.servo]\nlead = \"0.0021 s\"\n", aligned).empty());
}

TEST(ServoCheck, MotorsThatLeaveAnAxisOpenAreNamed) {
  const std::string open = "'truth.servo.motor_coupling' is singular";
  EXPECT_TRUE(says(with("motor_coupling = [[1, 0, 0], [1, 0, 0], [0, 0, 1]]"), open));
  EXPECT_TRUE(says(with("motor_coupling = [[0, 0, 0], [0, 0, 0], [0, 0, 0]]"), open));
  EXPECT_TRUE(says(with("motor_coupling = [[1, 2, 3], [4, 5, 6], [7, 8, 9]]"), open));
}

TEST(ServoCheck, ASweepIsJudgedByItsPoints) {
  const auto swept = [](const std::string& values) {
    return test::read_text(test::small_study + "[truth.servo]\nlead = \"0 s\"\n[sweep]\n" +
                               "\"truth.servo.lead\" = " + values + "\n",
                           servo);
  };
  EXPECT_EQ(mc::study_points(swept("[\"30 ms\", \"40 ms\"]")).size(), 2u);
  EXPECT_THROW(mc::study_points(swept("[\"30 ms\", \"2.1 ms\"]")), InputError);
}

TEST(ServoCheck, ALoopThatSettlesSlowerThanTheSamplesIsNoted) {
  const auto note = [](const std::string& gain, const mc::Overrides& overrides) {
    return mc::servo_notes(test::read_text(
        test::small_study + "[truth.servo]\nloop_gain = \"" + gain + " N*m/rad\"\n", overrides));
  };
  mc::Overrides short_rows = servo;
  short_rows.emplace_back("plan.sample", "1 min");
  EXPECT_EQ(note("200", short_rows), "");
  EXPECT_NE(note("0.001", short_rows).find("settles by a factor e in"), std::string::npos);
  EXPECT_EQ(note("0.001", servo), "");  // 100 s against rows of 2 min
  EXPECT_EQ(mc::servo_notes(test::read_text(test::small_study)), "");
}

TEST(ServoCheck, ABaseMotionWithoutAmplitudeOrFrequencyIsNoted) {
  const auto note = [](const std::string& lines) {
    return mc::servo_notes(test::read_text(test::small_study + "[truth.servo]\n" + lines, servo));
  };
  EXPECT_NE(note("base_frequency = \"1 Hz\"\n").find("without base_amplitude"), std::string::npos);
  EXPECT_NE(note("base_amplitude = \"1 deg\"\n").find("without base_frequency"), std::string::npos);
  EXPECT_EQ(note("base_amplitude = \"1 deg\"\nbase_frequency = \"1 Hz\"\n"), "");
}

}  // namespace
}  // namespace drift::servo_check_test
