#include "core/base/results/register.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <sstream>

#include "core/base/atomic_file.hpp"
#include "core/base/file_text.hpp"
#include "core/base/sha256.hpp"

namespace drift {
namespace {

constexpr std::string_view first_words = "# driftscope ";
constexpr std::size_t hash_digits = 64;

/// The first line of a register, whole or torn by a full disk, or what a power failure leaves of
/// it.
bool may_begin_one(const std::string& line) {
  return line.starts_with(first_words) || first_words.starts_with(line) ||
         line.find_first_not_of('\0') == std::string::npos;
}

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
  std::istringstream file(file_text(path_).value_or(""));
  bool first = true;
  for (std::string line; std::getline(file, line); first = false) {
    if (first && !may_begin_one(line)) foreign_ = true;
    if (line.starts_with(first_words)) {
      const std::size_t end = line.find(':');
      if (command_.empty() && end != std::string::npos)
        command_ = line.substr(first_words.size(), end - first_words.size());
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
  // One that is there may lack its first line: a process was killed before it was written.
  if (command_.empty())
    lines = fmt::format("{}{}: the files that driftscope wrote here; it replaces no others\n",
                        first_words, command);
  for (const auto& [name, hash] : files)
    if (hashes_.emplace(name, hash).second) lines += fmt::format("{}  {}\n", hash, name);
  if (lines.empty()) return;
  if (command_.empty()) command_ = command;
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

std::vector<std::string> changed_results(const std::string& folder) {
  HashedFiles present;
  for (const std::string& name : ResultsRegister(folder).names()) {
    const std::filesystem::path path = std::filesystem::path(folder) / name;
    std::error_code none;
    const std::filesystem::file_status status = std::filesystem::symlink_status(path, none);
    if (std::filesystem::exists(status))
      present.emplace_back(name, std::filesystem::is_regular_file(status)
                                     ? sha256_hex_of_file(path.string())
                                     : "no file");
  }
  // Read anew: a hash is noted before its file is written, by other processes too.
  const ResultsRegister known(folder);
  std::vector<std::string> changed;
  for (const auto& [name, hash] : present)
    if (!known.has(name, hash)) changed.push_back(name);
  return changed;
}

}  // namespace drift
