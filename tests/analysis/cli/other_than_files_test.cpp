// What is no file where driftscope keeps one: links, pipes, folders. Said before anything is
// changed, and never waited for.
#include <sys/stat.h>

#include <filesystem>

#include "tests/support/program.hpp"

namespace drift::other_than_files_test {
namespace {

using namespace drift::test;
namespace fs = std::filesystem;

/// One that may hang is ended.
Answer within_a_minute(const std::string& line) {
  return run_program("timeout", "60 '" DRIFT_PROGRAM "' " + line);
}

/// Puts something that is no file in place of `path`; `kind` is what a message calls it.
void put(const std::string& kind, const std::string& path) {
  fs::remove_all(path);
  if (kind == "a pipe") {
    ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  }
  if (kind == "a directory") fs::create_directory(path);
  if (kind == "a symbolic link") fs::create_symlink("nowhere", path);
}

constexpr const char* kinds[] = {"a pipe", "a directory", "a symbolic link"};

TEST(OtherThanFiles, ARegisterThatIsNoneIsSaidBeforeAnythingIsWritten) {
  const ScratchFolder scratch;
  const std::string study = scratch.write("s.toml", cheap_study()), out = scratch.file("out");
  for (const std::string kind : kinds)
    for (const std::string command : {"run --runs 64", "rank", "identify"}) {
      fs::remove_all(out);
      fs::create_directory(out);
      put(kind, out + "/.driftscope");
      const Answer a = within_a_minute(command + " " + study + " -o " + out);
      EXPECT_EQ(a.code, store_error) << command << a.err;
      EXPECT_NE(a.err.find("/.driftscope: is " + kind), std::string::npos) << a.err;
      EXPECT_EQ(std::distance(fs::directory_iterator(out), {}), 1) << "something was written";
    }
}

TEST(OtherThanFiles, WhatAStudyKeepsIsSaidByEveryCommand) {
  const ScratchFolder scratch;
  const std::string study = scratch.write("s.toml", cheap_study()), whole = scratch.file("whole"),
                    out = scratch.file("out");
  ASSERT_EQ(driftscope("run " + study + " --runs 64 -o " + whole).code, 0);
  for (const std::string kind : kinds)
    for (const std::string name : {"manifest.json", "worker-0000.sqlite",
                                   "worker-0000.sqlite-journal", "worker-0000.sqlite-wal"}) {
      fs::remove_all(out);
      fs::copy(whole, out);
      put(kind, out + "/" + name);
      for (const std::string& line :
           {"run " + study + " --runs 128 -o " + out, "status " + out, "verify " + out}) {
        const Answer a = within_a_minute(line);
        EXPECT_EQ(a.code, store_error) << line << ": " << name << "\n" << a.err;
        EXPECT_NE(a.err.find("/" + name + ": is " + kind), std::string::npos) << a.err;
      }
    }
}

}  // namespace
}  // namespace drift::other_than_files_test
