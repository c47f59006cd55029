#include "core/base/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "core/base/check.hpp"

namespace drift {

void throw_cannot_write(const std::string& path, const std::string& reason) {
  throw InputError(ExitCode::io,
                   fmt::format("{}: cannot be written: {} (expected a writable folder "
                               "with free space). Nothing was changed; choose another "
                               "place or make room",
                               path, reason));
}

namespace {

namespace fs = std::filesystem;

/// What is at a path and must stay there: all but regular files. Empty if the path is free.
std::string in_the_way(const std::string& path) {
  std::error_code none;
  switch (fs::symlink_status(path, none).type()) {
    case fs::file_type::directory:
      return "it is a directory";
    case fs::file_type::block:
    case fs::file_type::character:
      return "it is a device";
    case fs::file_type::fifo:
      return "it is a pipe";
    case fs::file_type::socket:
      return "it is a socket";
    case fs::file_type::symlink:
      return "it is a symbolic link to no regular file";
    default:
      return {};
  }
}

/// A symbolic link to a regular file stands for that file: the link stays.
std::string followed(std::string path) {
  std::error_code none;
  if (!fs::is_symlink(path, none) || !fs::is_regular_file(path, none)) return path;
  const fs::path target = fs::canonical(path, none);
  return none ? path : target.string();
}

}  // namespace

AtomicFile::AtomicFile(std::string path)
    : path_(followed(std::move(path))), temporary_(path_ + ".XXXXXX") {
  refuse_what_is_no_file();
  const int fd = ::mkostemp(temporary_.data(), O_CLOEXEC);
  if (fd < 0) throw_cannot_write(path_, std::strerror(errno));
  const mode_t mask = ::umask(0);  // the mode an ordinary new file gets
  ::umask(mask);
  ::fchmod(fd, 0666 & ~mask);
  ::close(fd);
}

AtomicFile::~AtomicFile() {
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void AtomicFile::refuse_what_is_no_file() const {
  if (const std::string what = in_the_way(path_); !what.empty()) throw_cannot_write(path_, what);
}

void AtomicFile::sync_temporary() {
  const int fd = ::open(temporary_.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0 || ::fsync(fd) != 0) {
    const int reason = errno;
    if (fd >= 0) ::close(fd);
    throw_cannot_write(path_, std::strerror(reason));
  }
  ::close(fd);
}

void AtomicFile::commit() {
  sync_temporary();
  refuse_what_is_no_file();  // rename() would replace it
  if (::rename(temporary_.c_str(), path_.c_str()) != 0)
    throw_cannot_write(path_, std::strerror(errno));
  temporary_.clear();
  sync_folder();
}

bool AtomicFile::commit_new() {
  sync_temporary();
  // A hard link is the one way to claim a name that network file systems know as well.
  if (::link(temporary_.c_str(), path_.c_str()) != 0) {
    if (errno == EEXIST) return false;
    if (errno != EPERM && errno != ENOTSUP && errno != ENOSYS)
      throw_cannot_write(path_, std::strerror(errno));
    // A file system without hard links is a local one.
    if (::renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, path_.c_str(), RENAME_NOREPLACE) != 0) {
      if (errno == EEXIST) return false;
      throw_cannot_write(path_, std::strerror(errno));
    }
    temporary_.clear();
  }
  sync_folder();
  return true;
}

void AtomicFile::sync_folder() {
  // The new name itself reaches the disk with its folder; not every file system allows that.
  const auto folder = std::filesystem::path(path_).parent_path();
  const int dir = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (dir >= 0) {
    ::fsync(dir);
    ::close(dir);
  }
}

}  // namespace drift
