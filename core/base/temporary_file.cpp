#include "core/base/temporary_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <vector>

#include "core/base/process_token.hpp"

namespace drift {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view prefix = ".driftscope-";
constexpr auto longest_life = std::chrono::hours(24);  // of a file whose maker cannot be seen

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
  std::string path =
      (fs::path(folder) / fmt::format("{}{}-XXXXXX", prefix, process_token())).string();
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
