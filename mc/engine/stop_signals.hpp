#pragma once

#include <csignal>

#include "core/base/check.hpp"

namespace drift::mc {

/// By these a user, a terminal or a batch system asks a program to end: USR1 and USR2 are sent by
/// sites before the time of a job is over.
inline constexpr int stop_signals[] = {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2};

/// Whatever asks for it, an interrupt is told from all other ends.
constexpr ExitCode code_of_stop(int signal) {
  return signal == SIGINT ? ExitCode::interrupted : ExitCode::terminated;
}

/// While it lives, stop_signals ask the engine to stop instead of ending the process; a second one
/// ends it at once. At most one at a time.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  /// Number of the signal that came, or 0.
  int caught() const;
};

}  // namespace drift::mc
