#pragma once

namespace drift::cli {

/// While it lives, mc::stop_signals say `words` on stderr and end the program at once,
/// with exit code 128 + the signal: for work whose every step is stored or not begun.
class StopAtOnce {
 public:
  explicit StopAtOnce(const char* words);
  ~StopAtOnce();
  StopAtOnce(const StopAtOnce&) = delete;
  StopAtOnce& operator=(const StopAtOnce&) = delete;
};

}  // namespace drift::cli
