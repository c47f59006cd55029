#include "core/base/temporary_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <climits>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <vector>

#include "core/base/process_token.hpp"

namespace drift {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view prefix = ".driftscope-";
constexpr auto longest_life = std::chrono::hours(24);  // of a file whose maker cannot be seen

/// Names of the temporaries that are alive, where a signal handler reaches them. A forked process
/// has those of its parent, which are not its own.
struct Alive {
  std::atomic<pid_t> maker{0};  ///< 0: none, or a name that is not whole
  std::array<char, PATH_MAX> path{};
};
std::array<Alive, 256> alive;
std::mutex changing;  // which a handler does not wait for
static_assert(std::atomic<pid_t>::is_always_lock_free);

/// To be called before the file is made: a signal may come at once. Where all places are taken, or
/// the name is too long to be one, the file is left to remove_stale_temporaries().
void note_alive(const std::string& path) {
  if (path.size() >= PATH_MAX) return;
  const std::scoped_lock lock(changing);
  const auto free = std::ranges::find_if(alive, [](const Alive& a) { return a.maker == 0; });
  if (free == alive.end()) return;
  std::memcpy(free->path.data(), path.c_str(), path.size() + 1);
  free->maker = ::getpid();
}

void forget(const std::string& path) {
  const std::scoped_lock lock(changing);
  for (Alive& a : alive)
    if (a.maker != 0 && path == a.path.data()) a.maker = 0;
}

/// A word that no other temporary of this process has.
std::string unused_word() {
  static std::atomic<unsigned> made{0};
  return fmt::format("{:06x}", made++);
}

bool older_than_a_life(const fs::path& path) {
  std::error_code gone;
  const auto written = fs::last_write_time(path, gone);
  return !gone && fs::file_time_type::clock::now() - written > longest_life;
}

bool is_stale(const fs::path& path) {
  const std::string token = path.filename().string().substr(prefix.size());
  switch (maker_of(std::string_view(token).substr(0, token.rfind('-')))) {
    case Maker::ended:
      return true;
    case Maker::unseen:
      return older_than_a_life(path);
    default:
      return false;
  }
}

/// The mode that an ordinary new file gets. Asking the kernel by umask() would change it for a
/// moment, for other threads too.
mode_t mode_of_new_files() {
  static const mode_t mode = [] {
    std::ifstream in("/proc/self/status");
    for (std::string line; std::getline(in, line);)
      if (unsigned mask = 0; std::sscanf(line.c_str(), "Umask: %o", &mask) == 1)
        return static_cast<mode_t>(0666 & ~mask);
    return static_cast<mode_t>(0600);
  }();
  return mode;
}

}  // namespace

std::string make_temporary(const std::string& folder) {
  for (;;) {
    const std::string name = fmt::format("{}{}-{}", prefix, process_token(), unused_word());
    const std::string path = (fs::path(folder) / name).string();
    note_alive(path);
    const int fd = ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    const int reason = errno;
    if (fd < 0) forget(path);
    if (fd < 0 && reason == EEXIST) continue;
    errno = reason;
    if (fd < 0) return {};
    ::fchmod(fd, mode_of_new_files());
    ::close(fd);
    return path;
  }
}

void remove_temporary(const std::string& path) {
  ::unlink(path.c_str());
  forget(path);
}

void remove_own_temporaries() noexcept {
  for (const Alive& a : alive)
    if (a.maker.load() == ::getpid()) ::unlink(a.path.data());
}

void remove_stale_temporaries(const std::string& folder) {
  std::error_code none;
  std::vector<fs::path> stale;
  for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, none))
    if (is_temporary(entry.path().filename().string()) && is_stale(entry.path()))
      stale.push_back(entry.path());
  for (const fs::path& path : stale) ::unlink(path.c_str());
}

bool is_temporary(std::string_view name) {
  return name.starts_with(prefix);
}

}  // namespace drift
