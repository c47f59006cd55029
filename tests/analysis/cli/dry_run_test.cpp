// What `run --dry-run` says of a folder, against what the run itself then does there.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>

#include "mc/store/worker_lock.hpp"
#include "tests/support/synthetic.hpp"

namespace drift::dry_run_test {
namespace {

using test::Answer;
using test::expect_says;
using test::ScratchFolder;
using test::study_file;
using test::synthetic;
namespace fs = std::filesystem;

/// Every file of a folder.
std::map<std::string, std::string> content(const std::string& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::directory_iterator(folder))
    files[entry.path().filename().string()] = test::text_of(entry.path().string());
  return files;
}

/// A dry run, which must leave the folder as it is.
Answer dry(const std::string& line, const std::string& folder) {
  const auto before = content(folder);
  const Answer answer = synthetic(line + " --dry-run");
  EXPECT_EQ(content(folder), before);
  return answer;
}

TEST(DryRun, WhatIsStoredIsNotToBeExecuted) {
  const ScratchFolder scratch;
  const std::string out = scratch.file("out"), line = "run " + study_file(scratch) + " -o " + out;
  const Answer fresh = synthetic(line + " --dry-run");
  EXPECT_EQ(fresh.code, 0) << fresh.err;
  expect_says(fresh.out, "stored           0 runs\n");
  expect_says(fresh.out, "to execute       200 runs, 4 blocks of runs\n");
  ASSERT_EQ(synthetic(line + " --worker 0/2").code, 0);  // the first and the third block
  const Answer rest = dry(line, out);
  EXPECT_EQ(rest.code, 0) << rest.err;
  expect_says(rest.out, "stored           128 runs\n");
  expect_says(rest.out, "to execute       72 runs, 2 blocks of runs\n");
  expect_says(dry(line + " --worker 1/2", out).out,
              "to execute       72 runs, 2 blocks of runs of this worker's part 1/2\n");
  expect_says(dry(line + " --worker 0/2", out).out,
              "to execute       nothing, this worker's part is complete; missing besides: 2 blocks "
              "of runs of the other workers' parts\n");
  expect_says(synthetic(line).err, "128 runs stored before, 72 executed");
  expect_says(dry(line, out).out, "to execute       nothing, the study is complete\n");
}

TEST(DryRun, AWorkerForWhomThereIsNoBlockIsToldSo) {
  const ScratchFolder scratch;
  const std::string out = scratch.file("out"), line = "run " + study_file(scratch) + " -o " + out,
                    empty =
                        "this part is empty: the study has 4 blocks of 64 runs, so at most 4 "
                        "workers can help";
  const std::string worker = line + " --worker 4/1000";
  expect_says(synthetic(worker + " --dry-run").out,
              "to execute       nothing, " + empty +
                  "; missing besides: 4 blocks of runs of the other workers' parts\n");
  const Answer run = synthetic(worker);
  EXPECT_EQ(run.code, 0) << run.err;
  expect_says(run.err, "note: --worker 4/1000: " + empty + "\n");
  EXPECT_EQ(synthetic(line + " --worker 3/1000").err.find("is empty"), std::string::npos);
  expect_says(synthetic(worker + " --runs 64").err,
              "the study has 1 block of 64 runs, so at most 1 worker can help\n");
}

TEST(DryRun, OfALongerOrShorterStudyItSaysWhatTheRunWould) {
  const ScratchFolder scratch;
  const std::string out = scratch.file("out"), line = "run " + study_file(scratch) + " -o " + out;
  ASSERT_EQ(synthetic(line).code, 0);
  const Answer longer = dry(line + " --runs 300", out);
  expect_says(longer.out,
              "stored           192 runs; 8 more are in blocks that a shorter study ended within");
  expect_says(longer.out, "to execute       108 runs, 2 blocks of runs\n");
  ASSERT_EQ(synthetic(line + " --runs 300").code, 0);
  const Answer plain = dry(line, out);
  expect_says(plain.err, "300 runs per point were asked for before, 200 in the study file");
  expect_says(plain.out, "runs             300 ");
  expect_says(plain.err,
              "With --runs 200 it executes no more than those, and what is stored beyond");
  const Answer shorter = dry(line + " --runs 20", out);
  expect_says(shorter.err,
              "300 runs per point were asked for before, 20 now: what is stored stays");
  expect_says(shorter.out,
              "stored           300 runs, 280 of them beyond the 20 per point that are");
  expect_says(shorter.out, "to execute       nothing, the study is complete\n");
}

TEST(DryRun, WhatTheRunRefusesItRefusesInTheSameWords) {
  const ScratchFolder scratch;
  const std::string out = scratch.file("out"), line = "run " + study_file(scratch) + " -o " + out;
  ASSERT_EQ(synthetic(line).code, 0);
  const auto same = [&](const std::string& command, int code, const std::string& says) {
    const Answer said = synthetic(command + " --dry-run"), done = synthetic(command);
    EXPECT_EQ(said.code, code) << command;
    EXPECT_EQ(done.code, code) << command;
    EXPECT_EQ(said.err, done.err);
    expect_says(said.err, says);
  };
  same(line + " --seed 8", 7, "the folder holds another study");
  same(line + " --worker 4/4", 2, "--worker 4/4");
  const std::string manifest = test::text_of(out + "/manifest.json");
  std::ofstream(out + "/manifest.json") << manifest.substr(0, manifest.size() / 2);
  same(line, 7, "manifest.json: damaged");
  fs::remove(out + "/manifest.json");
  same(line + " --seed 8", 7, "holds results of another study");
  const std::string others = scratch.file("others");
  fs::create_directory(others);
  std::ofstream(others + "/report.html") << "mine";
  same("run " + study_file(scratch) + " -o " + others, 7, "which driftscope did not write");
}

TEST(DryRun, DamageIsNotCountedAsStored) {
  const ScratchFolder scratch;
  const std::string out = scratch.file("out"), line = "run " + study_file(scratch) + " -o " + out;
  ASSERT_EQ(synthetic(line).code, 0);
  std::ofstream(out + "/worker-0000.sqlite") << "no database";
  std::ofstream(out + "/study.toml") << "title = 3\n";
  const Answer damaged = dry(line, out);
  EXPECT_EQ(damaged.code, 0) << damaged.err;
  expect_says(damaged.err, "worker-0000.sqlite: damaged; what cannot be read of it is left out");
  expect_says(damaged.err, "study.toml is not that of the study: it would be written anew");
  expect_says(damaged.out, "to execute       200 runs, 4 blocks of runs\n");
}

TEST(DryRun, AWorkerAtWorkKeepsOthersOutAndIsNotDisturbed) {
  const ScratchFolder scratch;
  const std::string file = scratch.file("worker-0000.sqlite");
  EXPECT_NO_THROW(mc::require_no_other(file, 0.0));
  EXPECT_TRUE(fs::is_empty(scratch.path()));
  {
    const mc::WorkerLock at_work(file, 0.0);
    EXPECT_THROW(mc::require_no_other(file, 0.0), InputError);
  }
  EXPECT_NO_THROW(mc::require_no_other(file, 0.0));
  EXPECT_NO_THROW(mc::WorkerLock(file, 0.0));
}

}  // namespace
}  // namespace drift::dry_run_test
