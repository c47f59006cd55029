#include "core/base/results/turn.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <thread>

#include "core/base/check.hpp"

namespace drift {
namespace {

constexpr auto pause = std::chrono::milliseconds(50);
constexpr int most_pauses = 600;  // an answer is a few megabytes at most

}  // namespace

ResultsTurn::ResultsTurn(const ResultsFolder& folder) : fd_(-1) {
  begin_results(folder);
  fd_ = ::open(folder.path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  for (int i = 0; fd_ >= 0 && ::flock(fd_, LOCK_EX | LOCK_NB) != 0; ++i) {
    if (errno == EINTR) continue;
    if (errno != EWOULDBLOCK) return;  // no locks here
    if (i >= most_pauses) {
      ::close(fd_);
      throw InputError(ExitCode::store,
                       fmt::format("{}: another process is writing results there (expected it to "
                                   "end within {} s). Nothing was changed; wait for it, or give "
                                   "another folder with -o",
                                   folder.path, most_pauses * pause.count() / 1000));
    }
    std::this_thread::sleep_for(pause);
  }
}

ResultsTurn::~ResultsTurn() {
  if (fd_ >= 0) ::close(fd_);
}

}  // namespace drift
