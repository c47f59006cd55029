// A study file whose plan is written out says what of the sweep is not in it.
#include "analysis/report/page/planned_study.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace drift::planned_study_test {
namespace {

mc::Study study(const std::string& sweep) {
  return mc::read_study_text(R"(schema = 1
[site]
latitude = "45.75 deg"
[plan]
preset = "six"
dwell  = "10 min"
sample = "60 s"
[[filter]]
name     = "f"
coupling = "eq5"
)" + sweep,
                             "s.toml");
}

TEST(PlannedStudy, IsHeadedByWhatItDoesNotSweep) {
  const mc::Study swept = study(
      "[sweep]\n\"plan.dwell\" = [\"10 min\", \"20 min\"]\n\"plan.mode\" = [\"free\", "
      "\"level\"]\n");
  const auto [name, text] = report::extended_study_file("improved.toml", swept, {});
  EXPECT_EQ(name, "improved.toml");
  EXPECT_EQ(text.find("# improved.toml does not sweep plan.dwell and plan.mode: "), 0u) << text;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line) && line != "schema = 1";) {
    EXPECT_EQ(line.find("# "), 0u) << line;
    EXPECT_LE(line.size(), 100u) << line;
  }
  const mc::Study again = mc::read_study_text(text, name);
  EXPECT_TRUE(again.sweep.empty());
  EXPECT_EQ(again.plan.positions.size(), 6u);
}

TEST(PlannedStudy, HasNoHeadWhereNothingIsLeftOut) {
  const mc::Study plain = study("");
  EXPECT_EQ(report::unswept_text("corrected.toml", plain), "");
  const auto [name, text] =
      report::study_file_with_positions("corrected.toml", plain, plain.plan.positions);
  EXPECT_EQ(text.find('#'), std::string::npos) << text;
}

}  // namespace
}  // namespace drift::planned_study_test
