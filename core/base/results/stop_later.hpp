#pragma once

namespace drift {

/// While one lives, a signal that asks the program to end waits until the last of them is gone: for
/// work of milliseconds that must be done as a whole, such as the files of an answer taking the
/// place of another's. SIGKILL and a loss of power do not wait.
class StopLater {
 public:
  StopLater();
  ~StopLater();
  StopLater(const StopLater&) = delete;
  StopLater& operator=(const StopLater&) = delete;

  /// For the handler of such a signal: whether it is to return at once. The signal comes again
  /// then.
  static bool holds(int signal) noexcept;
};

}  // namespace drift
