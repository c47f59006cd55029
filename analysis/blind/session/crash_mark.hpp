#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace drift::blind {

/// While it lives, a crash of this thread (SIGSEGV, SIGABRT and their like) adds a line to a file
/// before the process ends. What ends a process from outside (SIGKILL, SIGTERM, Ctrl-C, a power
/// failure) is no crash and leaves nothing. At most one at a time in each thread.
class CrashMark {
 public:
  explicit CrashMark(std::string file);
  ~CrashMark();
  CrashMark(const CrashMark&) = delete;
  CrashMark& operator=(const CrashMark&) = delete;

 private:
  std::string file_;
  std::vector<char> stack_;  ///< for the handler: that of the thread may be what ran out
};

/// Crashes after which a trial is given up: whatever the program died of once, a second time shows
/// that it lies in the trial and not in the machine.
inline constexpr std::size_t most_crashes = 2;

/// The crashes that a file tells of, by the names of their signals.
std::vector<std::string> crashes_in(const std::string& file);

}  // namespace drift::blind
