// What is whole in a damaged worker file survives whatever happens while it is taken over.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>

#include "core/base/check.hpp"
#include "mc/store/store.hpp"
#include "tests/support/program.hpp"
#include "tests/support/synthetic_study.hpp"

namespace drift::salvage_test {
namespace {

namespace fs = std::filesystem;
using test::ScratchFolder;
using test::SyntheticStudy;

/// A study of 50 blocks, most of them whole in a file that was cut.
struct CutStudy {
  CutStudy() {
    study.options.threads = 1;
    before = study.run(folder.path());
    fs::resize_file(file, fs::file_size(file) * 9 / 10);
    mc::WorkerFile cut(file, std::make_shared<mc::Manifest>(study.manifest()),
                       mc::Database::Use::salvage);
    for (const mc::BlockEntry& e : cut.entries(0)) whole += cut.read(e).has_value();
  }
  /// Room for half of the file.
  rlimit half() const {
    rlimit limit{};
    ::getrlimit(RLIMIT_FSIZE, &limit);
    limit.rlim_cur = fs::file_size(file) / 2;
    return limit;
  }
  void expect_that_all_whole_blocks_are_there() {
    const mc::StudyOutcome after = study.run(folder.path());
    EXPECT_EQ(after.done, 8 * (50 - whole));
    EXPECT_EQ(after.digest, before.digest);
    ASSERT_FALSE(after.notes.empty());
    EXPECT_NE(after.notes[0].find(fmt::format("{} whole blocks taken over", whole)),
              std::string::npos)
        << after.notes[0];
    for (const auto& entry : fs::directory_iterator(folder.path()))
      EXPECT_FALSE(entry.path().filename().string().starts_with(".driftscope-")) << entry.path();
  }

  ScratchFolder folder;
  SyntheticStudy study{.task = {.columns = 100}, .options = {.runs = 400}, .block_size = 8};
  std::string file = folder.file("worker-0000.sqlite");
  mc::StudyOutcome before;
  std::size_t whole = 0;
};

TEST(Salvage, AFullDiskLeavesTheDamagedFileForTheNextSession) {
  CutStudy s;
  ASSERT_GT(s.whole, 30u);
  ASSERT_LT(s.whole, 50u);
  const std::string bytes = test::text_of(s.file);
  const rlimit room = s.half();
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);  // then writing fails with EFBIG
  ::setrlimit(RLIMIT_FSIZE, &room);
  ExitCode code = ExitCode::ok;
  try {
    const mc::WorkerStore store(s.folder.path(), 0, s.study.manifest());
  } catch (const InputError& error) {
    code = error.code();
  }
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(code, ExitCode::io);
  EXPECT_EQ(test::text_of(s.file), bytes);
  EXPECT_FALSE(fs::exists(s.folder.file("worker-0000.damaged-1")));
  s.expect_that_all_whole_blocks_are_there();
  EXPECT_EQ(test::text_of(s.folder.file("worker-0000.damaged-1")), bytes);
}

TEST(Salvage, AKillInTheMiddleOfItLosesNothing) {
  CutStudy s;
  const rlimit room = s.half();
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const rlimit no_core{0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core);
    std::signal(SIGXFSZ, SIG_DFL);  // the write that goes beyond the limit ends the process
    ::setrlimit(RLIMIT_FSIZE, &room);
    try {
      const mc::WorkerStore store(s.folder.path(), 0, s.study.manifest());
    } catch (...) {
    }
    ::_exit(0);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status)) << "it was not killed in the middle";
  EXPECT_EQ(WTERMSIG(status), SIGXFSZ);
  s.expect_that_all_whole_blocks_are_there();
}

TEST(Salvage, WhoHasTheDamagedFileOpenReadsTheOneThatReplacedIt) {
  CutStudy s;
  mc::StudyReader reader(s.folder.path());
  const auto readable = [&] {
    std::size_t found = 0;
    for (std::uint64_t first = 0; first < 400; first += 8) found += reader.read(0, first) ? 1 : 0;
    return found;
  };
  EXPECT_LT(readable(), 50u);
  mc::WorkerStore store(s.folder.path(), 0, s.study.manifest());
  reader.refresh();
  EXPECT_EQ(readable(), s.whole);
  mc::StoredBlock lost;
  lost.block = {0, 392, std::vector<mc::RunStatus>(8), std::vector<double>(800, 1.0)};
  ASSERT_EQ(reader.listed(0, 392), nullptr) << "the end of the file was cut off";
  store.commit(std::span(&lost, 1));
  reader.refresh();
  EXPECT_EQ(readable(), s.whole + 1) << "what the new file gets later is seen, too";
}

TEST(Salvage, AFileThatIsRemovedAtTheEndOfASessionLeavesItsBlocksToBeDone) {
  const ScratchFolder folder;
  SyntheticStudy study;
  study.options.share = {1, 2};
  study.run(folder.path());
  study.options.share = {};
  const auto end = study.run(
      folder.path(), [&](const mc::Progress&) { fs::remove(folder.file("worker-0001.sqlite")); });
  EXPECT_FALSE(end.complete);
  EXPECT_EQ(end.code, ExitCode::wall_time) << "who asks by exit codes goes on";
  EXPECT_TRUE(study.run(folder.path()).complete);
}

}  // namespace
}  // namespace drift::salvage_test
