#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "tests/support/program.hpp"

namespace drift::shared_memory_test {
namespace {

using test::ScratchFolder;

TEST(SharedMemory, AProcessThatIsKilledLeavesNothingThere) {
  const std::filesystem::path shared = "/dev/shm";
  const ScratchFolder folder;
  const std::string study = folder.write("cheap.toml", test::cheap_study()),
                    out = folder.file("out");
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    execl(DRIFT_PROGRAM, "driftscope", "run", study.c_str(), "--runs", "100000000", "-o",
          out.c_str(), "--progress", "none", nullptr);
    _exit(127);
  }
  // Its first results are stored by threads that OpenMP has started.
  const auto stored = [&] {
    std::error_code none;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(out, none))
      if (entry.path().extension() == ".sqlite" && entry.file_size(none) > 20000) return true;
    return false;
  };
  for (int k = 0; k < 600 && !stored(); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_TRUE(stored());
  kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status));
  const std::string of_child = "_" + std::to_string(child) + "_";
  std::error_code absent;  // then the run shows that it works without
  for (const auto& entry : std::filesystem::directory_iterator(shared, absent))
    EXPECT_EQ(entry.path().filename().string().find(of_child), std::string::npos) << entry.path();
}

}  // namespace
}  // namespace drift::shared_memory_test
