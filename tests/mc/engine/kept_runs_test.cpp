// Sessions that are shorter than a block: what they executed of it is where the next goes on.
#include <gtest/gtest.h>

#include <filesystem>

#include "mc/engine/engine.hpp"
#include "mc/engine/forecast.hpp"
#include "mc/engine/replay.hpp"
#include "mc/store/store.hpp"
#include "tests/support/program.hpp"
#include "tests/support/synthetic_study.hpp"

namespace drift::kept_runs_test {
namespace {

using test::ScratchFolder;
using test::SyntheticStudy;

/// 300 runs in blocks of 64, eight executed together by one thread.
SyntheticStudy lock_step_study() {
  SyntheticStudy study{.task = {.fail_every = 41, .together = 8}};
  study.options.threads = 1;
  study.options.allowed_failures = 1000;
  return study;
}

mc::StudyOutcome stopped_at(SyntheticStudy study, std::uint64_t run, const std::string& folder) {
  study.task.stop_at = run;
  return study.run(folder);
}

TEST(KeptRuns, ASessionStoppedInABlockIsGoneOnFromAndOnlyTheRestIsExecuted) {
  const ScratchFolder straight, folder;
  const SyntheticStudy study = lock_step_study();
  const auto whole = study.run(straight.path());
  const auto first = stopped_at(study, 20, folder.path());
  EXPECT_EQ(first.code, ExitCode::terminated);
  EXPECT_EQ(first.done, 0u) << "no block was finished";
  EXPECT_EQ(first.kept, 24u);
  EXPECT_EQ(first.kept_after, 24u);
  const auto second = stopped_at(study, 85, folder.path());
  EXPECT_EQ(second.kept_before, 24u);
  EXPECT_EQ(second.taken_over, 24u);
  EXPECT_EQ(second.done, 40u);
  EXPECT_EQ(second.kept, 24u);
  mc::Progress last;
  const auto third = study.run(folder.path(), [&](const mc::Progress& p) { last = p; });
  EXPECT_EQ(third.done_before, 64u);
  EXPECT_EQ(third.kept_before, 24u);
  EXPECT_EQ(third.done, 300u - 88u);
  EXPECT_EQ(third.failed, whole.failed);
  EXPECT_EQ(third.digest, whole.digest);
  EXPECT_EQ(last.done, 300u);
  EXPECT_EQ(last.total, 300u);
  EXPECT_EQ(last.failed, whole.failed);
  EXPECT_TRUE(mc::StudyReader(folder.path()).kept().empty());
  EXPECT_TRUE(mc::StudyReader(folder.path()).misfits().empty()) << "failures and moments with it";
}

TEST(KeptRuns, SessionsShorterThanABlockComeToAnEnd) {
  const ScratchFolder straight, folder;
  SyntheticStudy study = lock_step_study();
  study.options.runs = 100;
  const auto whole = study.run(straight.path());
  study.options.max_wall = 1e-6;  // one group each
  std::size_t sessions = 1;
  auto last = study.run(folder.path());
  EXPECT_EQ(last.kept, 8u);
  for (; last.code == ExitCode::wall_time && sessions < 100; ++sessions)
    last = study.run(folder.path());
  EXPECT_TRUE(last.complete);
  EXPECT_EQ(last.code, ExitCode::ok);
  EXPECT_EQ(last.digest, whole.digest);
  EXPECT_EQ(sessions, 13u) << "100 runs in groups of 8, of which none is executed twice";
}

TEST(KeptRuns, AFlippedBitInThemIsToldAndThoseRunsAreExecutedAgain) {
  for (const char* damage :
       {"UPDATE partial SET payload = CAST(substr(payload, 1, 20) || x'5a' || substr(payload, 22) "
        "AS BLOB) WHERE first_run = 8",
        "UPDATE partial SET first_run = 32 WHERE first_run = 8",
        "UPDATE partial SET point = 7 WHERE first_run = 8",
        "UPDATE partial_failures SET cause = 'another'"}) {
    const ScratchFolder straight, folder;
    SyntheticStudy study = lock_step_study();
    study.task.fail_every = 11;  // run 10 fails first
    const auto whole = study.run(straight.path());
    ASSERT_EQ(stopped_at(study, 20, folder.path()).kept, 24u);
    mc::Database(folder.file("worker-0000.sqlite"), mc::Database::Use::write).execute(damage);
    const auto mended = study.run(folder.path());
    EXPECT_EQ(mended.digest, whole.digest) << damage;
    EXPECT_LT(mended.kept_before, 24u) << damage;
    EXPECT_EQ(mended.done, 300u - mended.kept_before) << damage;
    ASSERT_EQ(mended.notes.size(), 1u) << damage;
    EXPECT_NE(mended.notes[0].find("kept of unfinished blocks"), std::string::npos);
  }
}

TEST(KeptRuns, TablesThatCannotBeWorkedWithAreDropped) {
  const ScratchFolder straight, folder;
  const SyntheticStudy study = lock_step_study();
  const auto whole = study.run(straight.path());
  stopped_at(study, 20, folder.path());
  mc::Database(folder.file("worker-0000.sqlite"), mc::Database::Use::write)
      .execute("ALTER TABLE partial RENAME COLUMN first_run TO first_rum");
  EXPECT_EQ(study.run(folder.path()).digest, whole.digest);
  EXPECT_FALSE(std::filesystem::exists(folder.file("worker-0000.damaged-1")));
}

TEST(KeptRuns, GroupsOfAnotherSizeAreExecutedAgain) {
  const ScratchFolder straight, folder;
  SyntheticStudy study = lock_step_study();
  const auto whole = study.run(straight.path());
  stopped_at(study, 20, folder.path());
  study.task.together = 4;
  const auto rest = study.run(folder.path());
  EXPECT_EQ(rest.done, 300u);
  EXPECT_EQ(rest.digest, whole.digest);
}

TEST(KeptRuns, TheyAreNoResults) {
  const ScratchFolder folder;
  const SyntheticStudy study = lock_step_study();
  stopped_at(study, 85, folder.path());
  mc::StudyReader reader(folder.path());
  std::uint64_t results = 0;
  reader.each_result({}, [&](const mc::StoredBlock& b) { results += b.block.status.size(); });
  EXPECT_EQ(results, 64u);
  const auto verified = mc::verify(study.work(), reader, 1.0, 1);
  EXPECT_EQ(verified.runs, 64u);
  EXPECT_TRUE(verified.damage.empty());
  EXPECT_TRUE(verified.mismatch.empty());
  EXPECT_EQ(mc::runs_of(reader.kept()), 24u);
  const auto would =
      mc::forecast(study.work(), study.options, folder.path(), study.manifest(), true, 0);
  EXPECT_EQ(would.stored, 64u);
  EXPECT_EQ(would.kept, 24u);
}

TEST(KeptRuns, AnotherWorkerGoesOnFromThemToo) {
  const ScratchFolder straight, folder;
  SyntheticStudy study = lock_step_study();
  const auto whole = study.run(straight.path());
  study.options.share = {1, 2};
  EXPECT_EQ(stopped_at(study, 85, folder.path()).kept, 24u);
  study.options.share = {};
  const auto rest = study.run(folder.path());
  EXPECT_EQ(rest.kept_before, 24u);
  EXPECT_EQ(rest.done, 300u - 24u);
  EXPECT_EQ(rest.digest, whole.digest);
  EXPECT_TRUE(mc::StudyReader(folder.path()).kept().empty()) << "their blocks are stored";
}

TEST(KeptRuns, AStudyThatIsExtendedGoesOnFromWholeGroups) {
  const ScratchFolder straight, folder;
  SyntheticStudy study = lock_step_study();
  const auto whole = study.run(straight.path());
  study.options.runs = 100;  // the last group is cut at 4 runs
  EXPECT_EQ(stopped_at(study, 85, folder.path()).kept, 24u);
  study.options.runs = 300;
  const auto more = study.run(folder.path());
  EXPECT_EQ(more.done, 300u - 88u);
  EXPECT_EQ(more.digest, whole.digest);
}

TEST(KeptRuns, AFailedRunIsStoppedAtAgainByTheSameCall) {
  const ScratchFolder folder;
  SyntheticStudy study{.task = {.throw_at = 20, .together = 8}};
  study.options.threads = 1;
  study.options.fail_fast = true;
  const auto first = study.run(folder.path());
  EXPECT_EQ(first.code, ExitCode::failed_runs);
  EXPECT_EQ(first.kept, 16u);
  EXPECT_EQ(first.dropped, 8u);
  const auto again = study.run(folder.path());
  EXPECT_EQ(again.code, ExitCode::failed_runs);
  EXPECT_EQ(again.kept_before, 16u);
  ASSERT_TRUE(again.failed_first);
  EXPECT_EQ(again.failed_first->failure.run, 20u);
}

TEST(KeptRuns, AFailedRunThatCompletesItsBlockIsStoppedAtAgain) {
  // The last run of the first block; and with threads, whoever executes the last of it.
  for (const auto& [run, threads] : {std::pair{63u, 1}, {20u, 3}}) {
    const ScratchFolder folder;
    SyntheticStudy study{.task = {.throw_at = run, .milliseconds = 0.2, .together = 8}};
    study.options.threads = threads;
    study.options.fail_fast = true;
    for (int call = 0; call < 3; ++call) {
      const auto end = study.run(folder.path());
      EXPECT_EQ(end.code, ExitCode::failed_runs) << run << ", call " << call;
      ASSERT_TRUE(end.failed_first) << run << ", call " << call;
      EXPECT_EQ(end.failed_first->failure.run, run);
      mc::StudyReader reader(folder.path());
      EXPECT_FALSE(reader.read(0, 0)) << "the block of a failed run is not stored";
    }
    study.options.fail_fast = false;
    study.options.allowed_failures = 1;
    EXPECT_EQ(study.run(folder.path()).failed, 1u);
  }
}

TEST(KeptRuns, AShorterStudyThatIsCompleteLeavesThoseOfALongerOne) {
  const ScratchFolder folder;
  SyntheticStudy study = lock_step_study();
  EXPECT_EQ(stopped_at(study, 85, folder.path()).kept, 24u);
  study.options.runs = 64;
  EXPECT_TRUE(study.run(folder.path()).complete);
  study.options.runs = 300;
  EXPECT_EQ(study.run(folder.path()).kept_before, 24u);
}

TEST(KeptRuns, CopiesOfTwoWorkersThatDifferAreExecutedAgainAndTold) {
  const ScratchFolder straight, folder;
  SyntheticStudy study = lock_step_study();
  const auto whole = study.run(straight.path());
  study.options.share = {0, 2};
  stopped_at(study, 20, folder.path());
  study.options.share = {};
  const mc::Manifest manifest = study.manifest();
  std::vector<mc::StoredBlock> parts = mc::StudyReader(folder.path()).kept();
  ASSERT_EQ(parts.size(), 3u);
  parts[1].block.rows[0] += 1e-3;  // a faulty machine
  mc::WorkerStore(folder.path(), 1, manifest).keep(parts);
  const auto rest = study.run(folder.path());
  EXPECT_EQ(rest.kept_before, 16u);
  EXPECT_EQ(rest.digest, whole.digest);
  ASSERT_EQ(rest.notes.size(), 1u);
  EXPECT_NE(rest.notes[0].find("runs 8 to 15 of point 0 differ"), std::string::npos)
      << rest.notes[0];
}

TEST(KeptRuns, AFileOfAnUninterruptedStudyHasNoTableForThem) {
  const ScratchFolder folder;
  lock_step_study().run(folder.path());
  mc::Database db(folder.file("worker-0000.sqlite"), mc::Database::Use::read);
  mc::Statement tables =
      db.prepare("SELECT count(*) FROM sqlite_master WHERE name LIKE 'partial%'");
  ASSERT_TRUE(tables.step());
  EXPECT_EQ(tables.integer(0), 0) << "its bytes are those of a file of before";
}

}  // namespace
}  // namespace drift::kept_runs_test
