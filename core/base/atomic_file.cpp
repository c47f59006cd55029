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

void AtomicFile::write(std::string_view text) {
  const auto failed = [&](int reason) { throw_cannot_write(path_, std::strerror(reason)); };
  const int fd = ::open(temporary_.c_str(), O_WRONLY | O_CLOEXEC);
  if (fd < 0) failed(errno);
  while (!text.empty()) {
    const ssize_t done = ::write(fd, text.data(), text.size());
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) {
      const int reason = errno;
      ::close(fd);
      failed(reason);
    }
    text.remove_prefix(static_cast<std::size_t>(done));
  }
  if (::close(fd) != 0) failed(errno);  // a full disk may show only here
}

void AtomicFile::sync() {
  const int fd = ::open(temporary_.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0 || ::fsync(fd) != 0) {
    const int reason = errno;
    if (fd >= 0) ::close(fd);
    throw_cannot_write(path_, std::strerror(reason));
  }
  ::close(fd);
}

void AtomicFile::commit() {
  sync();
  require_file_name(path_);  // rename() would replace it
  if (::rename(temporary_.c_str(), path_.c_str()) != 0)
    throw_cannot_write(path_, std::strerror(errno));
  sync_folder();
}

bool AtomicFile::commit_new() {
  sync();
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

std::string AtomicFile::put() {
  if (std::string what = in_the_way(path_); !what.empty()) return what;
  std::error_code none;
  const bool replaces = fs::exists(fs::symlink_status(path_, none));
  if (replaces) {
    if (::renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, path_.c_str(), RENAME_EXCHANGE) == 0) {
      moved_ = Moved::for_old_file;
      return {};
    }
    // Network file systems do not exchange; what else fails, a plain rename would meet too.
    if (errno != EINVAL && errno != ENOSYS && errno != ENOTSUP) return std::strerror(errno);
  }
  if (::rename(temporary_.c_str(), path_.c_str()) != 0) return std::strerror(errno);
  moved_ = replaces ? Moved::over_old_file : Moved::to_free_name;
  return {};
}

std::string AtomicFile::take_away() {
  if (::rename(path_.c_str(), temporary_.c_str()) == 0)
    moved_ = Moved::away;
  else if (errno != ENOENT)
    return std::strerror(errno);
  return {};
}

bool AtomicFile::take_back() {
  const char *name = path_.c_str(), *temporary = temporary_.c_str();
  bool done = true;
  switch (moved_) {
    case Moved::nothing:
      break;
    case Moved::to_free_name:
      done = ::rename(name, temporary) == 0;
      break;
    case Moved::for_old_file:
      done = ::renameat2(AT_FDCWD, temporary, AT_FDCWD, name, RENAME_EXCHANGE) == 0;
      break;
    case Moved::over_old_file:
      done = false;
      break;
    case Moved::away:
      done = ::rename(temporary, name) == 0;
      break;
  }
  moved_ = Moved::nothing;
  return done;
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
