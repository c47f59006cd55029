#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "core/base/check.hpp"
#include "core/base/temporary_file.hpp"

namespace drift::test {

/// Exit codes of the program.
inline constexpr int usage_error = static_cast<int>(ExitCode::usage),
                     config_error = static_cast<int>(ExitCode::config),
                     recording_error = static_cast<int>(ExitCode::recording),
                     io_error = static_cast<int>(ExitCode::io),
                     store_error = static_cast<int>(ExitCode::store);

/// What a run of the program answered.
struct Answer {
  int code = -1;
  std::string out, err;
};

/// Temporary files of this program in a folder.
inline std::size_t temporaries_in(const std::string& folder) {
  std::size_t n = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    n += is_temporary(entry.path().filename().string());
  return n;
}

/// A folder that is gone after the test.
class ScratchFolder {
 public:
  ScratchFolder()
      : path_(std::filesystem::temp_directory_path() /
              ("driftscope_" +
               std::string(
                   ::testing::UnitTest::GetInstance()->current_test_info()->test_suite_name()) +
               "_" + ::testing::UnitTest::GetInstance()->current_test_info()->name() + "_" +
               std::to_string(getpid()) + "_" + std::to_string(made()++))) {
    std::filesystem::create_directories(path_);
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::string file(const std::string& name) const { return (path_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(file(name), std::ios::binary) << text;
    return file(name);
  }
  std::string path() const { return path_.string(); }

 private:
  static std::atomic<int>& made() {
    static std::atomic<int> count = 0;
    return count;
  }
  std::filesystem::path path_;
};

inline std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Runs `program arguments` and keeps what it prints.
inline Answer run_program(const std::string& program, const std::string& arguments) {
  const ScratchFolder scratch;
  const std::string err = scratch.file("stderr");
  const std::string line = "'" + program + "' " + arguments + " 2>'" + err + "'";
  Answer answer;
  std::FILE* pipe = popen(line.c_str(), "r");
  std::array<char, 4096> buffer{};
  while (const auto n = std::fread(buffer.data(), 1, buffer.size(), pipe))
    answer.out.append(buffer.data(), n);
  const int status = pclose(pipe);
  answer.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  answer.err = text_of(err);
  return answer;
}

inline Answer driftscope(const std::string& arguments) {
  return run_program(DRIFT_PROGRAM, arguments);
}

inline std::string config(const std::string& name) {
  return std::string("'") + DRIFT_SOURCE_DIR + "/configs/" + name + "'";
}

/// configs/cheap.toml: two short positions, one filter of nine parameters, hundredths of a second.
inline std::string cheap_study() {
  return text_of(std::string(DRIFT_SOURCE_DIR) + "/configs/cheap.toml");
}

}  // namespace drift::test
