#include "core/base/results/register.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/base/atomic_file.hpp"

namespace drift {
namespace {

constexpr std::string_view first_words = "# driftscope ";
constexpr std::size_t hash_digits = 64;

/// A file descriptor that is closed; its lock, where the file system has locks, goes with it.
struct Appending {
  int fd;
  explicit Appending(const std::string& path)
      : fd(::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW, 0666)) {
    if (fd < 0) throw_cannot_write(path, std::strerror(errno));
    while (::flock(fd, LOCK_EX) != 0 && errno == EINTR) {
    }
  }
  ~Appending() { ::close(fd); }
  Appending(const Appending&) = delete;
  Appending& operator=(const Appending&) = delete;

  bool ends_within_a_line() const {
    char last = '\n';
    const off_t size = ::lseek(fd, 0, SEEK_END);
    return size > 0 && ::pread(fd, &last, 1, size - 1) == 1 && last != '\n';
  }
};

}  // namespace

ResultsRegister::ResultsRegister(std::string folder)
    : path_((std::filesystem::path(std::move(folder)) / file_name).string()) {
  std::error_code none;
  // One that is no regular file is not ours; writing to it is refused.
  if (!std::filesystem::is_regular_file(std::filesystem::symlink_status(path_, none))) return;
  exists_ = true;
  std::ifstream file(path_, std::ios::binary);
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with(first_words)) {
      if (command_.empty())
        command_ = line.substr(first_words.size(), line.find(':') - first_words.size());
    } else if (line.size() > hash_digits + 2 && line.substr(hash_digits, 2) == "  ") {
      hashes_.emplace(line.substr(hash_digits + 2), line.substr(0, hash_digits));
    }
  }
}

std::vector<std::string> ResultsRegister::names() const {
  std::vector<std::string> all;
  for (const auto& [name, hash] : hashes_)
    if (all.empty() || all.back() != name) all.push_back(name);
  return all;
}

void ResultsRegister::add(const std::string& command, const HashedFiles& files) {
  std::string lines;
  if (!exists_)
    lines = fmt::format("{}{}: the files that driftscope wrote here; it replaces no others\n",
                        first_words, command);
  for (const auto& [name, hash] : files)
    if (hashes_.emplace(name, hash).second) lines += fmt::format("{}  {}\n", hash, name);
  if (lines.empty()) return;
  if (!exists_) command_ = command;
  exists_ = true;
  const Appending file(path_);
  if (file.ends_within_a_line())
    lines.insert(lines.begin(), '\n');  // of a process that ended while writing
  const char* data = lines.data();
  for (std::size_t left = lines.size(); left > 0;) {
    const ssize_t done = ::write(file.fd, data, left);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) throw_cannot_write(path_, std::strerror(errno));
    data += done;
    left -= static_cast<std::size_t>(done);
  }
  if (::fsync(file.fd) != 0) throw_cannot_write(path_, std::strerror(errno));
}

}  // namespace drift
