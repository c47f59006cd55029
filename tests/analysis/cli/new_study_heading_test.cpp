// A log without headings of a case that did not face North: what all gimbals stand away from plain
// axes is its heading.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/recording/recording.hpp"
#include "tests/support/program.hpp"

namespace drift::new_study_heading_test {
namespace {

using namespace drift::test;

std::string study_of_a_case_at(int degrees) {
  const std::string heading = "case_heading = \"" + std::to_string(degrees) + " deg\"\n";
  std::string text =
      "schema = 1\ntitle = \"turned\"\n[site]\nlatitude = \"45.75 deg\"\n[plan]\ndwell = \"10 "
      "min\"\nsample = \"60 s\"\nmode = \"free\"\nentry = \"caged\"\n";
  for (const char* axes : {"x=U y=N z=W", "x=D y=N z=E", "x=N y=W z=U", "x=N y=E z=D"})
    text += std::string("[[plan.position]]\naxes = \"") + axes + "\"\n" + heading;
  const std::string model = "coupling = \"eq5\"\nterms = [\"fixed_drift\", \"accelerometer\"]\n";
  return text + "[truth]\n" + model + "[[filter]]\nname = \"nominal\"\n" + model;
}

/// The study that `new` makes of a log of such a test, which has no column of headings.
std::string made_of_a_case_at(int degrees) {
  const ScratchFolder folder;
  const std::string study = folder.write("study.toml", study_of_a_case_at(degrees)),
                    log = folder.file("log.csv"), made = folder.file("made.toml");
  EXPECT_EQ(driftscope("simulate '" + study + "' -o '" + log + "'").code, 0);
  Recording r = read_recording(log, RecordingKind::platform, 9.81);
  std::erase_if(r.channels, [](const Channel& c) { return c.name == "case_heading"; });
  write_recording(r, log);
  EXPECT_EQ(driftscope("new diagnose '" + log + "' -o '" + made + "'").code, 0);
  return text_of(made);
}

std::size_t count_of(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

TEST(NewStudyHeading, IsThatByWhichAllGimbalsStandAwayFromPlainAxes) {
  for (const int degrees : {20, 3, -7}) {
    const std::string made = made_of_a_case_at(degrees);
    EXPECT_EQ(count_of(made, "\ncase_heading = \"" + std::to_string(degrees) + " deg\""), 4u)
        << made;
    EXPECT_EQ(count_of(made, "turn  ="), 0u) << made;
    EXPECT_EQ(count_of(made, "axes  = \"x=N y=W z=U\""), 1u) << made;
  }
}

TEST(NewStudyHeading, IsNotWrittenOfACaseThatFacesNorth) {
  EXPECT_EQ(made_of_a_case_at(0).find("case_heading"), std::string::npos);
}

}  // namespace
}  // namespace drift::new_study_heading_test
