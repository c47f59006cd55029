#include "core/base/atomic_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "core/base/check.hpp"
#include "tests/support/program.hpp"

namespace drift::atomic_file_test {
namespace {

using test::ScratchFolder;
namespace fs = std::filesystem;

/// Writes "new" to a path; what the refusal says, or nothing.
std::string refusal(const std::string& path) {
  try {
    AtomicFile file(path);
    std::ofstream(file.temporary()) << "new";
    file.commit();
    return {};
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), ExitCode::io);
    return error.what();
  }
}

TEST(AtomicFile, ReplacesRegularFilesAlone) {
  const ScratchFolder scratch;
  EXPECT_EQ(refusal(scratch.file("free")), "");
  EXPECT_EQ(refusal(scratch.write("file", "old")), "");
  EXPECT_EQ(test::text_of(scratch.file("file")), "new");
  ASSERT_EQ(mkfifo(scratch.file("pipe").c_str(), 0600), 0);
  EXPECT_NE(refusal(scratch.file("pipe")).find("it is a pipe"), std::string::npos);
  EXPECT_TRUE(fs::is_fifo(scratch.file("pipe")));
  EXPECT_NE(refusal(scratch.path()).find("it is a directory"), std::string::npos);
  fs::create_symlink("nowhere", scratch.file("dangling"));
  EXPECT_NE(refusal(scratch.file("dangling")).find("symbolic link"), std::string::npos);
  fs::create_symlink(scratch.file("pipe"), scratch.file("to_pipe"));
  EXPECT_NE(refusal(scratch.file("to_pipe")).find("symbolic link"), std::string::npos);
  EXPECT_TRUE(fs::is_symlink(scratch.file("dangling")) && fs::is_symlink(scratch.file("to_pipe")));
}

TEST(AtomicFile, FollowsNoLink) {
  const ScratchFolder scratch;
  fs::create_directory(scratch.file("other"));
  scratch.write("other/file", "old");
  fs::create_symlink("other/file", scratch.file("link"));
  EXPECT_NE(refusal(scratch.file("link")).find("symbolic link"), std::string::npos);
  EXPECT_TRUE(fs::is_symlink(scratch.file("link")));
  EXPECT_EQ(test::text_of(scratch.file("other/file")), "old");
}

TEST(AtomicFile, ANameThatTheFileSystemRefusesIsSaidBeforeAnythingIsWritten) {
  const ScratchFolder scratch;
  EXPECT_NE(refusal(scratch.file(std::string(300, 'a'))).find("File name too long"),
            std::string::npos);
}

TEST(AtomicFile, WhatComesInTheWayMeanwhileStays) {
  const ScratchFolder scratch;
  AtomicFile file(scratch.file("name"));
  ASSERT_EQ(mkfifo(scratch.file("name").c_str(), 0600), 0);
  EXPECT_THROW(file.commit(), InputError);
  EXPECT_TRUE(fs::is_fifo(scratch.file("name")));
}

}  // namespace
}  // namespace drift::atomic_file_test
