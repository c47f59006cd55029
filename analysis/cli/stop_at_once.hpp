#pragma once

#include <string>
#include <string_view>

namespace drift::cli {

/// While it lives, mc::stop_signals say `words` on stderr, on a line of their own, and end the
/// program at once, with the signal's exit code (mc::code_of_stop): for work whose every step is
/// stored or not begun. Words end with the line. One may live within another.
class StopAtOnce {
 public:
  explicit StopAtOnce(std::string_view words);
  ~StopAtOnce();
  StopAtOnce(const StopAtOnce&) = delete;
  StopAtOnce& operator=(const StopAtOnce&) = delete;

  /// Other words from here on; not by two threads at a time.
  void say(std::string_view words);

 private:
  std::string before_;
};

}  // namespace drift::cli
