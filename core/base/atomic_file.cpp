#include "core/base/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "core/base/check.hpp"
#include "core/base/results/regular_file.hpp"
#include "core/base/temporary_file.hpp"

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

/// What is at a path and must stay there: all but regular files; or why the name cannot be used.
/// Empty if it can.
std::string in_the_way(const std::string& path) {
  std::error_code error;
  if (fs::symlink_status(path, error).type() == fs::file_type::none) return error.message();
  const std::string what = other_than_file(path);
  return what.empty() ? "" : "it is " + what;
}

std::string folder_of(const std::string& path) {
  const std::string folder = fs::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

}  // namespace

void require_file_name(const std::string& path) {
  if (const std::string what = in_the_way(path); !what.empty()) throw_cannot_write(path, what);
}

AtomicFile::AtomicFile(std::string path) : path_(std::move(path)) {
  require_file_name(path_);
  temporary_ = make_temporary(folder_of(path_));
  if (temporary_.empty()) throw_cannot_write(path_, std::strerror(errno));
}

AtomicFile::~AtomicFile() {
  remove_temporary(temporary_);
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
  require_file_name(path_);  // rename() would replace it
  if (::rename(temporary_.c_str(), path_.c_str()) != 0)
    throw_cannot_write(path_, std::strerror(errno));
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
  }
  sync_folder();
  return true;
}

void AtomicFile::sync_folder() {
  // The new name itself reaches the disk with its folder; not every file system allows that.
  const int dir = ::open(folder_of(path_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (dir < 0) return;
  const int reason = ::fsync(dir) == 0 ? 0 : errno;
  ::close(dir);
  if (reason == EIO || reason == ENOSPC || reason == EDQUOT)
    throw InputError(ExitCode::io,
                     fmt::format("{}: is written, but its name may not have reached the disk: {} "
                                 "(expected a disk that takes it). Check the disk and run again",
                                 path_, std::strerror(reason)));
}

}  // namespace drift
