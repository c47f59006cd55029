#include "core/base/temporary_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <vector>

#include "core/base/sha256.hpp"

namespace drift {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view prefix = ".driftscope-";
constexpr auto longest_life = std::chrono::hours(24);  // of a file whose maker cannot be seen

std::string line_of(const char* path) {
  std::ifstream in(path);
  std::string line;
  std::getline(in, line);
  return line;
}

std::string short_hash(std::string_view text) {
  return sha256_hex(text).substr(0, 8);
}

/// Where process numbers mean the same process: the machine, since when it runs, and which of its
/// processes can be seen (a container has numbers of its own).
struct Home {
  std::string machine, boot, view;
};

const Home& home() {
  static const Home here = [] {
    std::array<char, 256> name{};
    ::gethostname(name.data(), name.size() - 1);
    std::error_code none;
    return Home{short_hash(name.data()), short_hash(line_of("/proc/sys/kernel/random/boot_id")),
                short_hash(fs::read_symlink("/proc/self/ns/pid", none).string())};
  }();
  return here;
}

/// When a process was started, in the kernel's own count; 0 if that cannot be read. Tells it from
/// a later one of the same number.
std::uint64_t start_of(long pid) {
  const std::string line = line_of(fmt::format("/proc/{}/stat", pid).c_str());
  // After the name, which may hold anything, in parentheses: start time is the 20th field.
  std::size_t at = line.rfind(')');
  for (int field = 0; field < 20 && at != std::string::npos; ++field) at = line.find(' ', at + 1);
  std::uint64_t start = 0;
  if (at != std::string::npos)
    std::from_chars(line.data() + at + 1, line.data() + line.size(), start);
  return start;
}

std::vector<std::string> split(std::string_view text) {
  std::vector<std::string> parts{""};
  for (const char c : text)
    if (c == '-')
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

template <class Number>
Number number_of(const std::string& text) {
  Number n{};
  std::from_chars(text.data(), text.data() + text.size(), n);
  return n;
}

bool older_than_a_life(const fs::path& path) {
  std::error_code gone;
  const auto written = fs::last_write_time(path, gone);
  return !gone && fs::file_time_type::clock::now() - written > longest_life;
}

bool is_stale(const fs::path& path) {
  const auto parts = split(path.filename().string().substr(prefix.size()));
  if (parts.size() != 6) return false;
  const Home maker{parts[0], parts[1], parts[2]};
  if (maker.machine != home().machine) return older_than_a_life(path);
  if (maker.boot != home().boot) return true;
  if (maker.view != home().view) return older_than_a_life(path);
  const auto pid = number_of<long>(parts[3]);
  const auto start = number_of<std::uint64_t>(parts[4]);
  if (pid <= 0) return false;
  if (::kill(static_cast<pid_t>(pid), 0) != 0 && errno == ESRCH) return true;
  const std::uint64_t now = start_of(pid);
  return now != 0 && start != 0 && now != start;
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
  const Home& here = home();
  const long pid = ::getpid();
  std::string path =
      (fs::path(folder) / fmt::format("{}{}-{}-{}-{}-{}-XXXXXX", prefix, here.machine, here.boot,
                                      here.view, pid, start_of(pid)))
          .string();
  const int fd = ::mkostemp(path.data(), O_CLOEXEC);
  if (fd < 0) return {};
  ::fchmod(fd, mode_of_new_files());
  ::close(fd);
  return path;
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
