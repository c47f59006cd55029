#include "mc/store/provenance.hpp"

#include <fmt/format.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <fstream>

#include "core/base/build_info.hpp"
#include "core/base/file_text.hpp"
#include "core/base/rng.hpp"
#include "core/base/utf8.hpp"

namespace drift::mc {
namespace {

/// The value of the first line "key<blanks><separator> value" of a system file; empty if there is
/// none.
std::string line_of(const char* file, std::string_view key, char separator) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with(key)) continue;
    const auto at = line.find(separator);
    if (at == std::string::npos) continue;
    std::string value = line.substr(at + 1);
    std::erase(value, '"');
    value.erase(0, value.find_first_not_of(" \t"));
    return value;
  }
  return {};
}

std::string command_line() {
  std::string text = file_text("/proc/self/cmdline").value_or("");
  while (!text.empty() && text.back() == '\0') text.pop_back();
  std::replace(text.begin(), text.end(), '\0', ' ');
  return utf8_text(text);
}

}  // namespace

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text.data();
}

Facts provenance() {
  const BuildInfo& build = build_info();
  utsname system{};
  uname(&system);
  std::string libraries;
  for (const auto& [name, version] : build.libraries)
    libraries += fmt::format("{}{} {}", libraries.empty() ? "" : ", ", name, version);
  return {{"program", "driftscope " + build.version},
          {"commit", build.commit},
          {"build", build.build_type},
          {"compiler", build.compiler},
          {"flags", build.flags},
          {"instruction_set", build.instruction_set},
          {"arithmetic", arithmetic_fingerprint()},
          {"random_numbers", Stream::scheme},
          {"libraries", libraries},
          {"processor", line_of("/proc/cpuinfo", "model name", ':')},
          {"operating_system", line_of("/etc/os-release", "PRETTY_NAME", '=') + ", " +
                                   system.sysname + " " + system.release},
          {"host", utf8_text(system.nodename)},
          {"process", std::to_string(getpid())},
          {"command_line", command_line()},
          {"started_utc", utc_now()}};
}

}  // namespace drift::mc
