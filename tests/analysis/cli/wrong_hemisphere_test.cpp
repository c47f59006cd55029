// A study of another latitude. Of the other hemisphere: three drifts along the input axes take most
// of it up.
#include <gtest/gtest.h>

#include "tests/support/program.hpp"

namespace drift::wrong_hemisphere_test {
namespace {

using test::driftscope, test::ScratchFolder;

TEST(WrongHemisphere, IsTheFirstThingThatIdentifySaysThoughChiSquareHardlyShowsIt) {
  const ScratchFolder folder;
  const std::string terms =
      "terms = [\"fixed_drift\", \"g_drift\", \"g2_drift\", \"gyro_misalignment\", "
      "\"torquer_scale\", \"accelerometer\"]\n";
  const std::string study = folder.write(
      "lab.toml",
      "schema = 1\n[site]\nlatitude = \"52.1 deg\"\n[plan]\npreset = \"twelve\"\nmode = \"free\"\n"
      "dwell = \"60 min\"\nsample = \"120 s\"\n[truth]\ncoupling = \"eq5\"\n" +
          terms + "[[filter]]\nname = \"nominal\"\ncoupling = \"eq5\"\n" + terms);
  const std::string recording = folder.file("r.csv");
  ASSERT_EQ(driftscope("simulate " + study + " -o " + recording).code, 0);
  const auto right = driftscope("identify " + study + " " + recording);
  EXPECT_EQ(right.out.find("Fits: "), 0u) << right.out;
  const auto wrong =
      driftscope("identify " + study + " " + recording + " --set site.latitude='\"-52.1 deg\"'");
  EXPECT_EQ(wrong.code, 0) << wrong.err;
  EXPECT_NE(wrong.out.substr(0, wrong.out.find('.')).find("latitude of [site] is not that"),
            std::string::npos)
      << wrong.out;
  EXPECT_NE(wrong.out.find("--set site.latitude=\"52."), std::string::npos) << wrong.out;
}

/// Times that are tried beside the latitude make no recording of the plan: nobody's mistake but the
/// program's own.
TEST(WrongLatitude, FarOffIsSaidOfAPlanWithSlewsToo) {
  const ScratchFolder folder;
  const std::string study = test::config("table1.toml"), recording = folder.file("r.csv");
  ASSERT_EQ(driftscope("simulate " + study + " -o " + recording).code, 0);
  for (const std::string command : {"identify ", "diagnose "}) {
    const auto wrong =
        driftscope(command + study + " " + recording + " --set site.latitude='\"55 deg\"'");
    EXPECT_EQ(wrong.code, 0) << wrong.err;
    EXPECT_NE(wrong.out.find("latitude of [site] is not that"), std::string::npos) << wrong.out;
  }
}

}  // namespace
}  // namespace drift::wrong_hemisphere_test
