#pragma once

namespace drift::mc {

/// While it lives, SIGINT, SIGTERM and SIGHUP ask the engine to stop instead of ending the process;
/// a second signal ends it at once. At most one at a time.
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
