#include "core/sim/atomic_file.hpp"

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

AtomicFile::AtomicFile(std::string path) : path_(std::move(path)), temporary_(path_ + ".XXXXXX") {
  if (std::error_code none; std::filesystem::is_directory(path_, none))
    throw_cannot_write(path_, "it is a directory");
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
    if (errno != EPERM && errno != ENOTSUP && errno != ENOSYS) throw_cannot_write(path_, std::strerror(errno));
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
