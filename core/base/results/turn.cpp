#include "core/base/results/turn.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <thread>

#include "core/base/check.hpp"

namespace drift {
namespace {

constexpr auto pause = std::chrono::milliseconds(50);
constexpr int most_pauses = 600;  // an answer is a few megabytes at most

/// Whether a folder is still what stands at the path: another process may have taken it away.
bool stands_at(int fd, const std::string& path) {
  struct stat opened {
  }, there{};
  return ::fstat(fd, &opened) == 0 && ::stat(path.c_str(), &there) == 0 &&
         opened.st_dev == there.st_dev && opened.st_ino == there.st_ino;
}

}  // namespace

ResultsTurn::ResultsTurn(const ResultsFolder& folder) : folder_(folder) {
  while (!locked()) {
    ::close(fd_);
    begun_->stay();  // of a folder that is gone there is nothing to take away
  }
}

bool ResultsTurn::locked() {
  const ResultsFolder& folder = folder_;
  begun_.emplace(folder);
  fd_ = ::open(folder.path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd_ < 0) return true;  // what is wrong shows when a file is written
  for (int i = 0; ::flock(fd_, LOCK_EX | LOCK_NB) != 0; ++i) {
    if (errno == EINTR) continue;
    if (errno != EWOULDBLOCK) {  // no locks here: others may be writing
      begun_->stay();
      return true;
    }
    if (i >= most_pauses) {
      ::close(fd_);
      begun_->stay();
      throw InputError(ExitCode::store,
                       fmt::format("{}: another process is writing results there (expected it to "
                                   "end within {} s). Nothing was changed; wait for it, or give "
                                   "another folder with -o",
                                   folder.path, most_pauses * pause.count() / 1000));
    }
    std::this_thread::sleep_for(pause);
  }
  return stands_at(fd_, folder.path);
}

ResultsTurn::~ResultsTurn() {
  begun_.reset();  // before another process has its turn
  if (fd_ >= 0) ::close(fd_);
}

}  // namespace drift
