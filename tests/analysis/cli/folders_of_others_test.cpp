// Folders within a results folder, and files that the machinery of one would take for its own.
#include <gtest/gtest.h>

#include <filesystem>

#include "mc/store/store_database.hpp"
#include "tests/support/program.hpp"

namespace drift::folders_of_others_test {
namespace {

using namespace drift::test;
namespace fs = std::filesystem;

struct Desk : ScratchFolder {
  Desk() {
    write("s.toml", cheap_study());
    fs::create_directory(file("out"));
  }
  Answer blind() const {
    return driftscope("blind " + config("blind_small.toml") + " --trials 1 --progress none -o " +
                      file("out"));
  }
  Answer rank() const {
    return driftscope("rank " + file("s.toml") + " --improve 1 --progress none -o " + file("out"));
  }
  Answer run() const {
    return driftscope("run " + file("s.toml") + " --runs 64 -o " + file("out"));
  }
};

void expect_refused(const Answer& a, const std::string& part) {
  EXPECT_EQ(a.code, store_error) << a.err;
  EXPECT_NE(a.err.find(part), std::string::npos) << a.err;
  EXPECT_EQ(a.out, "");
}

TEST(FoldersOfOthers, WhatLiesInTheFolderOfPartsStays) {
  const Desk desk;
  fs::create_directory(desk.file("out/making"));
  desk.write("out/making/thesis.txt", "mine");
  expect_refused(desk.blind(), "holds making, which driftscope did not write");
  EXPECT_EQ(text_of(desk.file("out/making/thesis.txt")), "mine");
}

TEST(FoldersOfOthers, WhatWasPutBesideThePartsStays) {
  const Desk desk;
  ASSERT_EQ(desk.blind().code, 0);
  EXPECT_FALSE(fs::exists(desk.file("out/making")));
  fs::create_directory(desk.file("out/making"));
  desk.write("out/making/thesis.txt", "mine");
  EXPECT_EQ(desk.blind().code, 0);
  EXPECT_EQ(text_of(desk.file("out/making/thesis.txt")), "mine");
}

TEST(FoldersOfOthers, AStudyInAFolderOfTrialsIsNobodysButItsOwners) {
  const Desk desk;
  fs::create_directories(desk.file("out/trials/0001"));
  desk.write("out/trials/0001/study.toml", "# mine");
  expect_refused(desk.blind(), "holds trials, which driftscope did not write");
  EXPECT_EQ(text_of(desk.file("out/trials/0001/study.toml")), "# mine");
}

TEST(FoldersOfOthers, ALinkedFolderLeadsNothingOut) {
  for (const bool own : {false, true}) {
    const Desk desk;
    fs::create_directory(desk.file("else"));
    if (own) {
      ASSERT_EQ(driftscope("rank " + desk.file("s.toml") + " -o " + desk.file("out")).code, 0);
    }
    fs::create_symlink("../else", desk.file("out/candidates"));
    expect_refused(desk.rank(), own ? "candidates: is a symbolic link" : "holds candidates");
    EXPECT_TRUE(fs::is_empty(desk.file("else")));
  }
}

TEST(FoldersOfOthers, AListThatIsNotOursIsNotAddedTo) {
  const Desk desk;
  desk.write("out/.driftscope", "notes on the drift scope\n");
  expect_refused(desk.run(), ".driftscope: is not the list of files");
  EXPECT_EQ(text_of(desk.file("out/.driftscope")), "notes on the drift scope\n");
  desk.write("out/.driftscope", "# drifts");  // torn by a full disk
  EXPECT_EQ(desk.run().code, 0);
}

TEST(FoldersOfOthers, WhatStandsWhereTheResultsGoIsSaidBeforeTheyAreComputed) {
  const Desk desk;
  const std::string run = "run " + desk.file("s.toml") + " --runs 256 -o " + desk.file("out");
  ASSERT_EQ(driftscope(run + " --worker 0/2").code, 0);
  desk.write("out/summary.json", "mine");
  const Answer a = driftscope(run);
  expect_refused(a, "summary.json is there, and not in the list of what driftscope wrote");
  EXPECT_EQ(a.err.find("executed"), std::string::npos) << a.err;
  EXPECT_EQ(text_of(desk.file("out/summary.json")), "mine");
  fs::remove(desk.file("out/summary.json"));
  EXPECT_EQ(driftscope(run).code, 0);
}

TEST(FoldersOfOthers, NoJournalIsTakenForOneOfADatabaseToCome) {
  for (const char* name : {"worker-0000.sqlite-journal", "worker-0000.sqlite-wal"}) {
    const Desk desk;
    desk.write(std::string("out/") + name, "mine");
    expect_refused(desk.run(), std::string("holds ") + name);
    EXPECT_EQ(text_of(desk.file(std::string("out/") + name)), "mine");
  }
}

TEST(FoldersOfOthers, ADatabaseUnderTheNameOfAWorkerFileIsNoResult) {
  const Desk desk;
  const std::string path = desk.file("out/worker-0000.sqlite");
  mc::Database(path, mc::Database::Use::write)
      .execute("CREATE TABLE blocks (x); INSERT INTO blocks VALUES (1)");
  const std::string bytes = text_of(path);
  expect_refused(desk.run(), "holds worker-0000.sqlite, which driftscope did not write");
  EXPECT_EQ(text_of(path), bytes);
}

TEST(FoldersOfOthers, AWorkerFileOfOursIsKnownByItselfWhereAllElseIsLost) {
  const Desk desk;
  ASSERT_EQ(desk.run().code, 0);
  for (const auto& entry : fs::directory_iterator(desk.file("out")))
    if (entry.path().filename() != "worker-0000.sqlite") fs::remove_all(entry);
  const Answer again = desk.run();
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_FALSE(fs::exists(desk.file("out/worker-0000.damaged-1"))) << again.err;
}

}  // namespace
}  // namespace drift::folders_of_others_test
