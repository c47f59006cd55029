// A study that is asked for more runs than its file says; what is said of its sessions.
#include <gtest/gtest.h>

#include <filesystem>

#include "mc/store/store_database.hpp"
#include "mc/store/worker_lock.hpp"
#include "tests/support/synthetic.hpp"

namespace drift::extended_study_test {
namespace {

using test::Answer;
using test::expect_says;
using test::ScratchFolder;
using test::study_file;
using test::synthetic;
namespace fs = std::filesystem;

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
  expect_says(shorter.err, "20 runs of those asked for stored before, 0 executed");
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

std::string titled_study(const ScratchFolder& scratch, const std::string& title) {
  return scratch.write("study.toml", "schema = 1\ntitle = \"" + title +
                                         "\"\n[site]\nlatitude = \"45.75 deg\"\n[plan]\npreset = "
                                         "\"six\"\n[truth]\ncoupling = \"eq5\"\n[[filter]]\nname = "
                                         "\"eq5\"\ncoupling = \"eq5\"\n[monte_carlo]\nruns = 200\n"
                                         "seed = 7\n");
}

TEST(StudySessions, WhoIsAtWorkAndWhoWasKilledIsToldApart) {
  const ScratchFolder scratch;
  const std::string out = scratch.file("out"), worker = out + "/worker-0000.sqlite";
  ASSERT_EQ(synthetic("run " + titled_study(scratch, "") + " -o " + out).code, 0);
  expect_says(synthetic("status " + out).out, " with exit code 0\n");
  // What a process leaves that is killed.
  mc::Database(worker, mc::Database::Use::write)
      .execute("UPDATE sessions SET ended_utc = NULL, exit_code = NULL");
  expect_says(synthetic("status " + out).out, "worker-0000.sqlite: killed\n");
  {
    const mc::WorkerLock lock(worker, 0.0);
    EXPECT_EQ(mc::is_at_work(worker), mc::AtWork::yes);
    expect_says(synthetic("status " + out).out, "worker-0000.sqlite: at work\n");
  }
  EXPECT_EQ(mc::is_at_work(worker), mc::AtWork::no);
  EXPECT_EQ(mc::is_at_work(scratch.file("worker-0001.sqlite")), mc::AtWork::no);
  // The session after it has an end: the first stays killed, whoever works now.
  ASSERT_EQ(synthetic("run " + titled_study(scratch, "") + " -o " + out).code, 0);
  const mc::WorkerLock lock(worker, 0.0);
  const std::string said = synthetic("status " + out).out;
  expect_says(said, "worker-0000.sqlite: killed\n");
  expect_says(said, " with exit code 0\n");
}

/// 200 runs of 10 ms on one thread take 2 s, the first line of JSON comes after 1 s; the rule never
/// has enough.
TEST(StudySessions, WithAStopRuleTheTotalIsCalledTheMost) {
  const ScratchFolder scratch;
  const std::string run = "run " + titled_study(scratch, "half_width=0.000001 ms=10") +
                          " --threads 1 --progress json -o " + scratch.file("out");
  const std::string said = synthetic(run).err;
  expect_says(said, "\"total\":200,");
  expect_says(said, "\"at_most\":true}");
  expect_says(said, "\"done\":200,");
  expect_says(said, "\"at_most\":false}");
}

}  // namespace
}  // namespace drift::extended_study_test
