// A study that is asked for more runs than its file says.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/synthetic.hpp"

namespace drift::extended_study_test {
namespace {

using test::Answer;
using test::expect_says;
using test::ScratchFolder;
namespace fs = std::filesystem;

/// 200 runs.
std::string study_file(const ScratchFolder& scratch) {
  return scratch.write(
      "study.toml",
      "schema = 1\n[site]\nlatitude = \"45.75 deg\"\n[plan]\npreset = \"six\"\n[truth]\n"
      "coupling = \"eq5\"\n[[filter]]\nname = \"eq5\"\ncoupling = \"eq5\"\n"
      "[monte_carlo]\nruns = 200\nseed = 7\nallowed_failures = 99\n");
}

TEST(ExtendedStudy, AStudyThatWasExtendedIsMissedToItsNewEnd) {
  const ScratchFolder scratch;
  const std::string config = study_file(scratch), out = scratch.file("out");
  ASSERT_EQ(test::synthetic("run " + config + " -o " + out).code, 0);
  const Answer longer = test::synthetic("run " + config + " --runs 300 -o " + out);
  expect_says(longer.err, "200 runs stored before, 108 executed");
  expect_says(longer.err,
              "8 of the runs stored before were in blocks that the shorter study ended within");
  const Answer shorter = test::synthetic("run " + config + " --runs 20 -o " + out);
  EXPECT_EQ(shorter.out, longer.out);
  expect_says(shorter.err, "300 runs per point were asked for before, 20 now");
  fs::remove(out + "/worker-0000.sqlite");
  expect_says(test::synthetic("status " + out).out, "0 of 300 runs");
  EXPECT_EQ(test::synthetic("verify " + out).code, 7);
}

TEST(ExtendedStudy, AnExtensionThatWasBrokenOffIsGoneOnWith) {
  const ScratchFolder scratch;
  const std::string config = study_file(scratch), out = scratch.file("out");
  ASSERT_EQ(test::synthetic("run " + config + " -o " + out).code, 0);
  ASSERT_EQ(test::synthetic("run " + config + " --runs 300 --worker 0/2 -o " + out).code, 0);
  EXPECT_EQ(test::synthetic("status " + out).code, 75);
  const Answer plain = test::synthetic("run " + config + " -o " + out);
  EXPECT_EQ(plain.code, 0) << plain.err;
  expect_says(plain.err, "300 runs per point were asked for before, 200 in the study file");
  expect_says(plain.out, "runs 300,");
  EXPECT_EQ(test::synthetic("status " + out).code, 0);
}

}  // namespace
}  // namespace drift::extended_study_test
