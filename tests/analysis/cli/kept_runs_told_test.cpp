// What the commands say of a session that was stopped within a block.
#include <gtest/gtest.h>

#include "tests/support/synthetic.hpp"

namespace drift::kept_runs_told_test {
namespace {

using test::Answer;
using test::expect_says;
using test::ScratchFolder;
using test::synthetic;

/// 200 runs in blocks of 64, eight executed together.
std::string study_file(const ScratchFolder& scratch, const std::string& words) {
  return scratch.write(
      "study.toml", "schema = 1\ntitle = \"synthetic together=8 " + words +
                        "\"\n[site]\nlatitude = \"45.75 deg\"\n[plan]\npreset = \"six\"\n[truth]\n"
                        "coupling = \"eq5\"\n[[filter]]\nname = \"eq5\"\ncoupling = \"eq5\"\n"
                        "[monte_carlo]\nruns = 200\nseed = 7\n");
}

TEST(KeptRunsTold, ASignalWithinABlockLosesNoGroupOfRuns) {
  const ScratchFolder scratch;
  const std::string out = scratch.file("out"),
                    line = "run " + study_file(scratch, "stop_at=20") + " --threads 1 -o " + out;
  const Answer first = synthetic(line);
  EXPECT_EQ(first.code, 143) << first.err;
  expect_says(first.err, "stopped: 0 runs are stored in " + out +
                             ", 24 of unfinished blocks are kept; the same command goes on");
  const Answer status = synthetic("status " + out);
  EXPECT_EQ(status.code, 75);
  expect_says(status.out, "0 of 200 runs, 0 failed, 0 of 1 points complete");
  expect_says(status.out, "and 24 of unfinished blocks are kept");
  expect_says(synthetic("verify " + out).out, "0 blocks with 0 runs, 4 missing");
  const Answer would = synthetic(line + " --dry-run");
  expect_says(would.out, "stored           0 runs; 24 more, of unfinished blocks, are kept\n");
  expect_says(would.out, "to execute       176 runs, 4 blocks of runs\n");
  const Answer rest = synthetic(line);
  EXPECT_EQ(rest.code, 0) << rest.err;
  expect_says(rest.err, "0 runs stored before and 24 of unfinished blocks kept, 176 executed");
  EXPECT_EQ(synthetic("status " + out).out.find("unfinished"), std::string::npos);
  expect_says(synthetic("verify " + out).out, "sound and complete");
}

TEST(KeptRunsTold, AWallThatIsShorterThanAGroupIsNamed) {
  const ScratchFolder scratch;
  const std::string out = scratch.file("out"), line = "run " + study_file(scratch, "ms=1") +
                                                      " --threads 1 --max-wall 0.001s -o " + out;
  const Answer first = synthetic(line);
  EXPECT_EQ(first.code, 75) << first.err;
  expect_says(first.err, "0 runs stored before, 0 executed in ");
  expect_says(first.err, "; 8 more, of unfinished blocks, are kept\n");
  expect_says(first.err, "longer than --max-wall");
  expect_says(synthetic(line).err, "0 runs stored before and 8 of unfinished blocks kept, 0 ");
}

}  // namespace
}  // namespace drift::kept_runs_told_test
