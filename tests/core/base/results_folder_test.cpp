#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <thread>

#include "core/base/atomic_file.hpp"
#include "core/base/check.hpp"
#include "core/base/results/folder.hpp"
#include "core/base/results/register.hpp"
#include "core/base/results/turn.hpp"
#include "core/base/sha256.hpp"
#include "tests/support/program.hpp"

namespace drift::results_folder_test {
namespace {

using test::ScratchFolder;
using test::temporaries_in;
using test::text_of;
namespace fs = std::filesystem;

/// A process that begins a file and is ended before it can finish or tidy up.
void killed_writer(const std::string& path) {
  const pid_t child = fork();
  if (child == 0) {
    const AtomicFile file(path);
    _exit(0);
  }
  waitpid(child, nullptr, 0);
}

TEST(Temporaries, OfKilledProcessesVanishAndThoseOfLivingOnesStay) {
  const ScratchFolder scratch;
  const AtomicFile alive(scratch.file("a.txt"));
  killed_writer(scratch.file("b.txt"));
  scratch.write(".driftscope-notes", "mine");
  ASSERT_EQ(temporaries_in(scratch.path()), 3u);
  remove_stale_temporaries(scratch.path());
  EXPECT_TRUE(fs::exists(alive.temporary()));
  EXPECT_TRUE(fs::exists(scratch.file(".driftscope-notes")));
  EXPECT_EQ(temporaries_in(scratch.path()), 2u);
}

/// As a signal that ends the process would: while one file is written and after another was
/// renamed.
TEST(Temporaries, OfThisProcessAreRemovedAtOnceAndNoOthers) {
  const ScratchFolder scratch;
  const std::string done = scratch.file("done.txt");
  AtomicFile renamed(done), begun(scratch.file("a.txt"));
  renamed.commit();
  const pid_t child = fork();
  if (child == 0) {  // has the names of its parent, which are at work
    remove_own_temporaries();
    _exit(0);
  }
  waitpid(child, nullptr, 0);
  EXPECT_TRUE(fs::exists(begun.temporary()));
  remove_own_temporaries();
  EXPECT_FALSE(fs::exists(begun.temporary()));
  EXPECT_TRUE(fs::exists(done));
  EXPECT_EQ(temporaries_in(scratch.path()), 0u);
}

TEST(Temporaries, AreAsManyAsAreAsked) {
  const ScratchFolder scratch;
  std::vector<std::string> made;
  for (int i = 0; i < 300; ++i) made.push_back(make_temporary(scratch.path()));
  EXPECT_EQ(temporaries_in(scratch.path()), 300u);
  for (const std::string& path : made) remove_temporary(path);
  EXPECT_EQ(temporaries_in(scratch.path()), 0u);
}

TEST(Temporaries, LoosenTheMaskOfNoOtherThread) {
  const ScratchFolder scratch;
  const mode_t before = ::umask(077);
  std::atomic<bool> done = false;
  std::thread maker([&] {
    for (int i = 0; i < 2000; ++i) remove_temporary(make_temporary(scratch.path()));
    done = true;
  });
  const std::string path = scratch.file("of another thread");
  for (bool last = false; !last;) {
    last = done;
    const int fd = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
    struct stat made {};
    EXPECT_EQ(::fstat(fd, &made), 0);
    EXPECT_EQ(made.st_mode & 0777, 0600u);
    ::close(fd);
    ::unlink(path.c_str());
  }
  maker.join();
  ::umask(before);
}

TEST(Temporaries, OfAnotherMachineStayForADay) {
  const ScratchFolder scratch;
  const std::string other = scratch.write(".driftscope-00000000-00000000-00000000-1-1-abcdef", "x");
  remove_stale_temporaries(scratch.path());
  EXPECT_TRUE(fs::exists(other));
  fs::last_write_time(other, fs::file_time_type::clock::now() - std::chrono::hours(25));
  remove_stale_temporaries(scratch.path());
  EXPECT_FALSE(fs::exists(other));
}

TEST(Temporaries, VanishAtTheNextUseOfTheFolder) {
  const ScratchFolder scratch;
  const ResultsFolder folder{scratch.file("out"), "identify"};
  write_files(folder, {{"report.html", "page"}});
  killed_writer(scratch.file("out/report.html"));
  ASSERT_EQ(temporaries_in(folder.path), 1u);
  require_results_folder(folder);
  EXPECT_EQ(temporaries_in(folder.path), 0u);
}

TEST(ResultsTurns, OneAfterTheOtherWritesAnAnswer) {
  const ScratchFolder scratch;
  const ResultsFolder folder{scratch.file("out"), "identify"};
  auto first = std::make_unique<ResultsTurn>(folder);
  std::atomic<bool> has_turn = false;
  std::thread second([&] {
    const ResultsTurn turn(folder);
    has_turn = true;
    write_files(folder, {{"report.html", "second"}, {"identification.json", "second"}});
  });
  write_files(folder, {{"report.html", "first"}});
  std::this_thread::sleep_for(std::chrono::milliseconds(120));  // more than one look of the other
  EXPECT_FALSE(has_turn);
  write_files(folder, {{"identification.json", "first"}});
  first.reset();
  second.join();
  EXPECT_EQ(text_of(scratch.file("out/report.html")), "second");
  EXPECT_EQ(text_of(scratch.file("out/identification.json")), "second");
  EXPECT_EQ(temporaries_in(folder.path), 0u);
}

TEST(ResultsTurns, ThatWriteNothingLeaveNothing) {
  const ScratchFolder scratch;
  {
    const ResultsTurn turn({scratch.file("a/out"), "rank"});
    EXPECT_TRUE(fs::exists(scratch.file("a/out/.driftscope")));
  }
  EXPECT_FALSE(fs::exists(scratch.file("a"))) << "what was made above it is gone, too";
  fs::create_directory(scratch.file("mine"));
  scratch.write("mine/notes", "mine");
  { const ResultsTurn turn({scratch.file("mine"), "rank"}); }
  EXPECT_EQ(text_of(scratch.file("mine/notes")), "mine");
  EXPECT_FALSE(fs::exists(scratch.file("mine/.driftscope")));
  write_files({scratch.file("mine"), "rank"}, {{"rank.json", "1"}});
  { const ResultsTurn turn({scratch.file("mine"), "rank"}); }
  EXPECT_TRUE(fs::exists(scratch.file("mine/.driftscope"))) << "with the list of what is there";
}

TEST(ResultsTurns, AFolderThatWasTakenAwayMeanwhileIsMadeAnew) {
  const ScratchFolder scratch;
  const ResultsFolder folder{scratch.file("out"), "identify"};
  auto first = std::make_unique<ResultsTurn>(folder);
  std::thread second([&] {
    const ResultsTurn turn(folder);
    write_files(folder, {{"report.html", "second"}});
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(120));  // more than one look of the other
  first.reset();                                                // with nothing written
  second.join();
  EXPECT_EQ(text_of(scratch.file("out/report.html")), "second");
  EXPECT_NO_THROW(require_results_folder(folder));
}

TEST(ResultsFolderOf, TheFilesKnowTheCommandBetterThanTheRegister) {
  const ScratchFolder scratch;
  const ResultsFolder folder{scratch.file("out"), "rank"};
  write_files(folder, {{"rank.json", R"({"schema": 1, "linearised_at": "start"})"}});
  std::string list = text_of(scratch.file("out/.driftscope"));
  scratch.write("out/.driftscope", list.replace(list.find("rank"), 4, "run"));
  EXPECT_EQ(results_of(folder.path), "rank");
  EXPECT_NO_THROW(require_results_folder(folder));
}

TEST(ResultsFolderOf, TheCommandIsTheOneThatBeganIt) {
  const ScratchFolder scratch;
  EXPECT_EQ(results_of(scratch.file("none")), "");
  begin_results({scratch.file("out"), "blind"});
  EXPECT_EQ(results_of(scratch.file("out")), "blind");
  EXPECT_THROW(require_results_folder({scratch.file("out"), "run"}), InputError);
  EXPECT_NO_THROW(require_results_folder({scratch.file("out"), "blind"}));
}

TEST(ResultsFolderOf, AnEndAtAnyMomentLeavesAFolderThatCanBeUsedAgain) {
  // What a kill leaves between noting a hash and writing its file, and in the midst of noting it.
  const ScratchFolder scratch;
  const ResultsFolder folder{scratch.file("out"), "rank"};
  write_files(folder, {{"rank.json", "1"}});
  ResultsRegister(folder.path).add("rank", {{"rank.json", sha256_hex("2")}});
  EXPECT_NO_THROW(require_results_folder(folder)) << "the file before is ours still";
  scratch.write("out/rank.json", "2");
  EXPECT_NO_THROW(require_results_folder(folder)) << "and so is the one after";
  const std::string noted = text_of(scratch.file("out/.driftscope"));
  scratch.write("out/.driftscope", noted.substr(0, noted.size() - 7));  // torn: "2" is not noted
  EXPECT_THROW(require_results_folder(folder), InputError);
  scratch.write("out/rank.json", "1");
  write_files(folder, {{"rank.json", "3"}});
  EXPECT_NO_THROW(require_results_folder(folder)) << "what is noted later has a line of its own";
}

TEST(ResultsFolderOf, AKillBeforeTheFirstLineOfItsListIsWholeLeavesItTheCommands) {
  const ScratchFolder scratch;
  const ResultsFolder folder{scratch.file("out"), "blind"};
  begin_results(folder);
  const std::string whole = text_of(scratch.file("out/.driftscope"));
  for (std::size_t bytes = 0; bytes <= whole.size(); ++bytes) {
    scratch.write("out/.driftscope", whole.substr(0, bytes));
    begin_results(folder);
    fs::create_directory(scratch.file("out/trials"));  // what a worker goes on with
    EXPECT_EQ(results_of(folder.path), "blind") << bytes;
    EXPECT_NO_THROW(require_results_folder(folder)) << bytes;
    fs::remove(scratch.file("out/trials"));
  }
}

TEST(ResultsFolderOf, ManyMayBeginItAtTheSameTime) {
  const ScratchFolder scratch;
  for (int round = 0; round < 200; ++round) {
    const ResultsFolder folder{scratch.file(std::to_string(round)), "run"};
    fs::create_directory(folder.path);
    const pid_t other = fork();
    if (other == 0) {
      ::usleep(static_cast<useconds_t>(round));
      write_text_atomically(folder.path + "/manifest.json", R"({"study_hash": 1, "identity": 2})");
      _exit(0);
    }
    while (waitpid(other, nullptr, WNOHANG) == 0) EXPECT_NO_THROW(require_results_folder(folder));
  }
}

TEST(ResultsFolderOf, NothingIsWrittenThroughALinkedFolder) {
  const ScratchFolder scratch;
  const ResultsFolder folder{scratch.file("out"), "blind"};
  begin_results(folder);
  fs::create_directory(scratch.file("elsewhere"));
  fs::create_symlink("../elsewhere", scratch.file("out/trials"));
  EXPECT_THROW(write_files(folder, {{"trials/0001/study.toml", "x"}}), InputError);
  EXPECT_TRUE(fs::is_empty(scratch.file("elsewhere")));
}

}  // namespace
}  // namespace drift::results_folder_test
