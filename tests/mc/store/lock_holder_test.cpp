#include "mc/store/lock_holder.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>

#include "tests/support/program.hpp"
#include "tests/support/synthetic_study.hpp"

namespace drift::lock_holder_test {
namespace {

using Clock = std::chrono::steady_clock;

/// A process that has the file for itself and stops.
class StoppedWriter {
 public:
  explicit StoppedWriter(const std::string& path) : process_(::fork()) {
    if (process_ != 0) {
      int status = 0;
      ::waitpid(process_, &status, WUNTRACED);
      EXPECT_TRUE(WIFSTOPPED(status));
      return;
    }
    {
      mc::Database db(path, mc::Database::Use::write);
      db.execute("BEGIN EXCLUSIVE");
      std::raise(SIGSTOP);
      db.execute("ROLLBACK");
    }
    ::_exit(0);
  }
  ~StoppedWriter() { go_on(); }
  StoppedWriter(const StoppedWriter&) = delete;
  StoppedWriter& operator=(const StoppedWriter&) = delete;

  int process() const { return process_; }
  void go_on() {
    if (process_ < 0) return;
    ::kill(process_, SIGCONT);
    ::waitpid(process_, nullptr, 0);
    process_ = -1;
  }

 private:
  pid_t process_;
};

TEST(LockHolder, AReaderNamesAWriterThatWasStoppedAndDoesNotWaitForIt) {
  const test::ScratchFolder folder;
  const test::SyntheticStudy study;
  const std::string digest = study.run(folder.path()).digest;
  const std::string path = folder.file("worker-0000.sqlite");
  EXPECT_FALSE(mc::lock_holder(path));
  StoppedWriter writer(path);
  const auto holder = mc::lock_holder(path);
  ASSERT_TRUE(holder);
  EXPECT_EQ(holder->process, writer.process());
  EXPECT_TRUE(holder->is_stopped);
  const auto started = Clock::now();
  try {
    mc::StudyReader(folder.path());
    FAIL() << "a file in the middle of a change was read";
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), ExitCode::io);
    EXPECT_NE(std::string(error.what()).find(fmt::format("process {} keeps", writer.process())),
              std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find("kill -CONT"), std::string::npos) << error.what();
  }
  EXPECT_LT(Clock::now() - started, std::chrono::seconds(15)) << "a living writer gets 20 s";
  writer.go_on();
  mc::StudyReader after(folder.path());
  EXPECT_EQ(mc::results_digest(after, {}), digest);
}

}  // namespace
}  // namespace drift::lock_holder_test
