#include "core/base/process_token.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <vector>

#include "core/base/sha256.hpp"

namespace drift {
namespace {

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
    const auto view = std::filesystem::read_symlink("/proc/self/ns/pid", none).string();
    return Home{short_hash(name.data()), short_hash(line_of("/proc/sys/kernel/random/boot_id")),
                short_hash(view)};
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

}  // namespace

std::string process_token() {
  const long pid = ::getpid();
  return fmt::format("{}-{}-{}-{}-{}", home().machine, home().boot, home().view, pid,
                     start_of(pid));
}

Maker maker_of(std::string_view token) {
  const auto parts = split(token);
  if (parts.size() != 5) return Maker::none;
  const auto pid = number_of<long>(parts[3]);
  const auto start = number_of<std::uint64_t>(parts[4]);
  if (pid <= 0) return Maker::none;
  if (parts[0] != home().machine) return Maker::unseen;
  if (parts[1] != home().boot) return Maker::ended;
  if (parts[2] != home().view) return Maker::unseen;
  if (::kill(static_cast<pid_t>(pid), 0) != 0 && errno == ESRCH) return Maker::ended;
  const std::uint64_t now = start_of(pid);
  return now != 0 && start != 0 && now != start ? Maker::ended : Maker::at_work;
}

}  // namespace drift
