#include "mc/store/store.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

#include "core/base/check.hpp"
#include "mc/store/store_database.hpp"
#include "tests/support/program.hpp"
#include "tests/support/synthetic_study.hpp"

namespace drift::store_test {
namespace {

using test::ScratchFolder;
using test::SyntheticStudy;

/// A small study: blocks of 8 runs, so that a file has several and stays small.
SyntheticStudy small_study() {
  SyntheticStudy study{
      .task = {.fail_every = 11}, .options = {.runs = 40, .allowed_failures = 40}, .block_size = 8};
  study.options.threads = 1;
  return study;
}

void write_all(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

/// Blocks of the folder that can be read; each must be exactly the original.
std::size_t intact_blocks(const std::string& folder, const std::vector<mc::StoredBlock>& original) {
  mc::StudyReader reader(folder);
  std::size_t good = 0;
  for (const mc::StoredBlock& o : original) {
    const auto block = reader.read(0, o.block.first);
    if (!block) continue;
    EXPECT_EQ(mc::encode(block->block, 5), mc::encode(o.block, 5)) << "first run " << o.block.first;
    EXPECT_EQ(mc::encode(block->failures), mc::encode(o.failures));
    ++good;
  }
  return good;
}

std::vector<mc::StoredBlock> read_all(const std::string& folder) {
  std::vector<mc::StoredBlock> all;
  mc::StudyReader(folder).each_result({}, [&](const mc::StoredBlock& b) { all.push_back(b); });
  return all;
}

TEST(Store, GivesBackEveryBitWithFailuresAndTimes) {
  const ScratchFolder folder;
  const SyntheticStudy study;
  const auto manifest = study.manifest();
  mc::claim_folder(folder.path(), manifest);
  mc::StoredBlock block;
  block.block = {0,
                 64,
                 {mc::RunStatus::ok, mc::RunStatus::timeout},
                 {1.0, -0.0, 5e-324, INFINITY, -1e308, NAN, NAN,
                  std::bit_cast<double>(0x7ff8dead00000001u), 3.0, 4.0}};
  block.times = {0.5, 0.25, 1.0};
  block.failures = {{65, mc::RunStatus::timeout, "too long; \"quoted\"\n", 12.5, 0.75}};
  mc::WorkerStore(folder.path(), 3, manifest).commit(std::span(&block, 1));
  const auto back = mc::StudyReader(folder.path()).read(0, 64);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->block.status, block.block.status);
  EXPECT_EQ(std::memcmp(back->block.rows.data(), block.block.rows.data(), 80), 0);
  EXPECT_EQ(back->times.filter_s, 0.25);
  ASSERT_EQ(back->failures.size(), 1u);
  EXPECT_EQ(back->failures[0].cause, block.failures[0].cause);
  EXPECT_EQ(back->failures[0].t, 12.5);
  EXPECT_EQ(back->failures[0].seconds, 0.75);
  EXPECT_EQ(mc::worker_files(folder.path()), std::vector{folder.file("worker-0003.sqlite")});
}

TEST(Store, EveryBitFlipIsDetectedOrHarmless) {
  const ScratchFolder folder;
  small_study().run(folder.path());
  const std::string path = folder.file("worker-0000.sqlite"), bytes = test::text_of(path);
  const auto original = read_all(folder.path());
  ASSERT_EQ(original.size(), 5u);
  std::size_t lost = 0;
  // A step that is prime to page and record sizes: samples of every part of the file.
  for (std::size_t at = 0; at < bytes.size() * 8; at += 1543) {
    std::string damaged = bytes;
    damaged[at / 8] = static_cast<char>(damaged[at / 8] ^ (1 << at % 8));
    write_all(path, damaged);
    lost += original.size() - intact_blocks(folder.path(), original);
  }
  EXPECT_GT(lost, 0u) << "no flip hit a block: the test proves nothing";
}

TEST(Store, EveryTruncationIsDetectedOrHarmlessAndMendedByTheSameCall) {
  const ScratchFolder folder;
  const SyntheticStudy study = small_study();
  const std::string digest = study.run(folder.path()).digest;
  const std::string path = folder.file("worker-0000.sqlite"), bytes = test::text_of(path);
  const auto original = read_all(folder.path());
  for (std::size_t size = 0; size < bytes.size(); size += 3001) {
    write_all(path, bytes.substr(0, size));
    EXPECT_LE(intact_blocks(folder.path(), original), original.size());
    if (size % 4 != 0) continue;
    EXPECT_EQ(study.run(folder.path()).digest, digest) << "truncated to " << size;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
      if (entry.path().string().find("damaged") != std::string::npos)
        std::filesystem::remove(entry.path());
  }
}

TEST(Store, ADamagedBlockIsReportedAndComputedAnew) {
  const ScratchFolder folder;
  const SyntheticStudy study = small_study();
  const auto before = study.run(folder.path());
  const std::string path = folder.file("worker-0000.sqlite");
  mc::Database db(path, mc::Database::Use::write);
  db.execute("UPDATE blocks SET payload = zeroblob(length(payload)) WHERE first_run = 16");
  mc::StudyReader reader(folder.path());
  EXPECT_FALSE(reader.read(0, 16));
  ASSERT_EQ(reader.notes().size(), 1u);
  EXPECT_NE(reader.notes()[0].find("runs 16 to 23 is damaged"), std::string::npos)
      << reader.notes()[0];
  const auto after = study.run(folder.path());
  EXPECT_EQ(after.done, 8u);
  EXPECT_EQ(after.digest, before.digest);
  ASSERT_FALSE(after.notes.empty());
  EXPECT_NE(after.notes[0].find("1 damaged blocks removed"), std::string::npos) << after.notes[0];
}

TEST(Store, AFileThatIsTakenAwayIsNoFullDisk) {
  const ScratchFolder folder;
  const std::string path = folder.file("worker-0000.sqlite");
  mc::Database db(path, mc::Database::Use::write);
  db.execute("CREATE TABLE a (x)");
  std::filesystem::rename(path, folder.file("elsewhere"));
  try {
    db.execute("INSERT INTO a VALUES (1)");
    FAIL() << "was written to a file that has no name";
  } catch (const InputError& e) {
    EXPECT_EQ(e.code(), ExitCode::io);
    EXPECT_NE(std::string(e.what()).find("was removed or renamed"), std::string::npos) << e.what();
  }
}

TEST(Store, AFileThatIsNoDatabaseIsSetAsideAndABrokenOneGivesBackItsWholeBlocks) {
  const ScratchFolder folder;
  SyntheticStudy study = small_study();
  study.task.columns = 100;  // a block fills more than a page of 4 kB
  const auto before = study.run(folder.path());
  const std::string path = folder.file("worker-0000.sqlite");
  write_all(path, std::string(5000, 'x'));
  const auto after = study.run(folder.path());
  EXPECT_EQ(after.digest, before.digest);
  EXPECT_TRUE(std::filesystem::exists(folder.file("worker-0000.damaged-1")));
  std::string bytes = test::text_of(path);
  bytes.resize(bytes.size() -
               4096);  // the last page is gone: the structure is broken, most blocks are whole
  write_all(path, bytes);
  const auto again = study.run(folder.path());
  EXPECT_EQ(again.digest, before.digest);
  EXPECT_LT(again.done, 40u) << "whole blocks are taken over";
}

TEST(Store, RowsWhoseBlockIsGoneDoNotStandInTheWay) {
  const ScratchFolder folder;
  const SyntheticStudy study = small_study();
  const auto before = study.run(folder.path());
  mc::Database(folder.file("worker-0000.sqlite"), mc::Database::Use::write)
      .execute("DELETE FROM blocks WHERE id = (SELECT max(id) FROM blocks)");
  const auto after = study.run(folder.path());
  EXPECT_EQ(after.digest, before.digest);
  EXPECT_EQ(after.done, 8u);
}

TEST(Store, TheDatabaseOfSomebodyElseIsSetAsideUntouched) {
  const ScratchFolder folder;
  const SyntheticStudy study = small_study();
  mc::claim_folder(folder.path(), study.manifest());
  mc::Database(folder.file("worker-0000.sqlite"), mc::Database::Use::write)
      .execute("CREATE TABLE mine (x); INSERT INTO mine VALUES (1)");
  const std::string bytes = test::text_of(folder.file("worker-0000.sqlite"));
  study.run(folder.path());
  EXPECT_EQ(test::text_of(folder.file("worker-0000.damaged-1")), bytes);
}

TEST(Store, WhatRepeatsOtherTablesIsComparedWithThemAndMended) {
  for (const char* damage :
       {"UPDATE columns SET unit = 'rad' WHERE number = 1",
        "UPDATE study SET value = '2' WHERE key = 'seed'", "UPDATE moments SET mean = mean + 1e-9",
        "DELETE FROM moments WHERE number = 3", "UPDATE sessions SET runs = runs + 1024",
        "UPDATE blocks SET failed = failed + 1 WHERE first_run = 16"}) {
    const ScratchFolder folder;
    const SyntheticStudy study = small_study();
    const auto before = study.run(folder.path());
    EXPECT_TRUE(mc::StudyReader(folder.path()).misfits().empty());
    mc::Database(folder.file("worker-0000.sqlite"), mc::Database::Use::write).execute(damage);
    mc::StudyReader reader(folder.path());
    EXPECT_EQ(reader.misfits().size(), 1u) << damage;
    EXPECT_EQ(reader.runs(), 40u) << damage;
    EXPECT_EQ(study.run(folder.path()).digest, before.digest);
    EXPECT_TRUE(mc::StudyReader(folder.path()).misfits().empty()) << damage;
  }
}

/// How SQLite lists the blocks of a file.
std::string plan_of_listing(const std::string& path) {
  mc::Database db(path, mc::Database::Use::read);
  mc::Statement plan = db.prepare(
      "EXPLAIN QUERY PLAN SELECT id, point, first_run, runs, failed FROM blocks WHERE id > 0 "
      "ORDER BY id");
  return plan.step() ? plan.bytes(3) : "";
}

TEST(Store, BlocksAreListedByTheIndexAloneAndAFileOfBeforeGetsIt) {
  const ScratchFolder folder;
  const SyntheticStudy study = small_study();
  const auto before = study.run(folder.path());
  const std::string path = folder.file("worker-0000.sqlite");
  EXPECT_NE(plan_of_listing(path).find("COVERING INDEX listing"), std::string::npos);
  mc::Database(path, mc::Database::Use::write).execute("DROP INDEX listing");
  EXPECT_EQ(plan_of_listing(path).find("INDEX listing"), std::string::npos);
  EXPECT_EQ(intact_blocks(folder.path(), read_all(folder.path())), 5u);
  const auto after = study.run(folder.path());
  EXPECT_EQ(after.digest, before.digest);
  EXPECT_EQ(after.done, 0u) << "nothing is computed anew";
  EXPECT_NE(plan_of_listing(path).find("COVERING INDEX listing"), std::string::npos);
}

TEST(Store, AnIndexThatIsNotThatOfTheTableIsFoundAndCostsNoBlock) {
  const ScratchFolder folder;
  const SyntheticStudy study = small_study();
  const auto before = study.run(folder.path());
  const std::string path = folder.file("worker-0000.sqlite");
  mc::Database(path, mc::Database::Use::write)
      .execute(
          "DROP INDEX listing; CREATE INDEX listing ON blocks (id, point, first_run, runs, failed) "
          "WHERE id <> 2; PRAGMA writable_schema = 1; UPDATE sqlite_master SET sql = 'CREATE INDEX "
          "listing ON blocks (id, point, first_run, runs, failed)' WHERE name = 'listing'");
  EXPECT_EQ(mc::StudyReader(folder.path()).unsound(), std::vector{path});
  const auto after = study.run(folder.path());
  EXPECT_EQ(after.digest, before.digest);
  EXPECT_EQ(after.done, 0u) << "all blocks are taken over from the table";
  EXPECT_TRUE(mc::StudyReader(folder.path()).unsound().empty());
}

TEST(Store, EqualDuplicatesAreLegalAndOthersAreNot) {
  const ScratchFolder folder;
  const SyntheticStudy study = small_study();
  const auto outcome = study.run(folder.path());
  const auto manifest = study.manifest();
  auto block = *mc::StudyReader(folder.path()).read(0, 8);
  mc::WorkerStore(folder.path(), 1, manifest).commit(std::span(&block, 1));
  mc::StudyReader twice(folder.path());
  EXPECT_EQ(mc::results_digest(twice, {}), outcome.digest);
  block.block.rows[2] = std::nextafter(block.block.rows[2], 1e9);
  mc::WorkerStore(folder.path(), 2, manifest).commit(std::span(&block, 1));
  try {
    mc::StudyReader(folder.path()).read(0, 8);
    FAIL() << "a difference of one bit went unnoticed";
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), ExitCode::self_check);
  }
}

TEST(Store, ABlockOfAnotherStudyOrPlaceDoesNotFit) {
  const ScratchFolder folder;
  const SyntheticStudy study = small_study();
  study.run(folder.path());
  mc::Database db(folder.file("worker-0000.sqlite"), mc::Database::Use::write);
  db.execute("UPDATE blocks SET first_run = 48 WHERE first_run = 16");
  mc::StudyReader reader(folder.path());
  EXPECT_FALSE(reader.read(0, 48));
  EXPECT_TRUE(reader.read(0, 24));
}

TEST(Store, OneProcessAtATimeIsAWorker) {
  const ScratchFolder folder;
  const SyntheticStudy study;
  const auto manifest = study.manifest();
  mc::claim_folder(folder.path(), manifest);
  const mc::WorkerStore first(folder.path(), 0, manifest);
  EXPECT_NO_THROW(mc::WorkerStore(folder.path(), 1, manifest));
  EXPECT_THROW(mc::WorkerStore(folder.path(), 0, manifest, 0.1), InputError);
}

TEST(Store, ALengthThatNoRowHasIsDamageAndNoFaultOfTheDisk) {
  // Of a record whose header says gigabytes; found by FuzzNightly.Stores.
  const ScratchFolder folder;
  mc::Database db(folder.file("a.sqlite"), mc::Database::Use::write);
  try {
    db.prepare("SELECT zeroblob(2147483647) || 'x'").run();
    FAIL() << "read";
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), ExitCode::store) << error.what();
  }
}

}  // namespace
}  // namespace drift::store_test
