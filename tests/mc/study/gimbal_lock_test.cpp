// Positions that no platform can hold are told where they stand, with what would help.
#include <gtest/gtest.h>

#include "tests/mc/study/study_file.hpp"

namespace drift::gimbal_lock_test {
namespace {

/// Line 8 begins the second position: z west, the case turned so that its x axis is west.
std::string plan(const std::string& second) {
  return "schema = 1\n[site]\nlatitude = \"45 deg\"\n[plan]\ndwell = \"20 min\"\n"
         "[[plan.position]]\naxes = \"x=N y=W z=U\"\n[[plan.position]]\nname = \"b\"\n"
         "axes = \"x=U y=N z=W\"\n" +
         second + "[[filter]]\nname = \"f\"\ncoupling = \"eq5\"\n";
}

std::string mistake(const std::string& text) {
  const auto all = test::mistakes(text);
  EXPECT_EQ(all.size(), 1u);
  return all.empty() ? "" : all.front();
}

TEST(GimbalLock, IsSaidWithFileAndLineAndWhatHelps) {
  const std::string caged = mistake(plan("case_heading = \"90 deg\"\n"));
  EXPECT_EQ(caged.find("study.toml:8:"), 0u) << caged;
  EXPECT_NE(caged.find("position 2 ('b'): the middle gimbal would reach"), std::string::npos)
      << caged;
  EXPECT_NE(caged.find("Choose another case_heading"), std::string::npos) << caged;
  EXPECT_EQ(caged.find("entry = "), std::string::npos) << "it is caged";
  const std::string torqued = mistake(plan("case_heading = \"90 deg\"\nentry = \"torqued\"\n"));
  EXPECT_NE(torqued.find("entry = \"caged\""), std::string::npos) << torqued;
  EXPECT_TRUE(test::mistakes(plan("")).empty()) << "another heading, as it says";
}

TEST(GimbalLock, OfAPresetIsSaidAtThePreset) {
  // Near the pole a day turns z of the first position, which is level, past any axis of the case.
  const std::string text = mistake(
      "schema = 1\n[site]\nlatitude = \"80 deg\"\n[plan]\npreset = \"six\"\nmode = \"free\"\n"
      "dwell = \"24 h\"\n[[filter]]\nname = \"f\"\ncoupling = \"eq5\"\n");
  EXPECT_EQ(text.find("study.toml:5:"), 0u) << text;
  EXPECT_NE(text.find("a shorter dwell"), std::string::npos) << text;
}

TEST(GimbalLock, OfThePlanOfTheFileIsNoneWhereASweepChangesIt) {
  EXPECT_TRUE(test::mistakes("schema = 1\n[site]\nlatitude = \"80 deg\"\n[plan]\npreset = "
                             "\"six\"\nmode = \"free\"\ndwell = \"24 h\"\n[[filter]]\nname = "
                             "\"f\"\ncoupling = \"eq5\"\n[sweep]\n\"plan.dwell\" = [\"30 min\", "
                             "\"1 h\"]\n")
                  .empty());
}

}  // namespace
}  // namespace drift::gimbal_lock_test
