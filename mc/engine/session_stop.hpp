#pragma once

#include <atomic>
#include <optional>

#include "core/base/check.hpp"
#include "mc/engine/mpi_launch.hpp"
#include "mc/engine/stop_signals.hpp"
#include "mc/engine/time_for_groups.hpp"

namespace drift::mc {

/// Why a session of this process ends before its work is done: the first reason that came, and a
/// defect before all others. Thread-safe.
class SessionStop {
 public:
  enum Reason : int { none, asked, full_time, failed_run, elsewhere, broken };

  /// `max_wall` [s]: of the session; nothing: no limit.
  SessionStop(std::optional<double> max_wall, Ranks& ranks) : time_(max_wall), ranks_(ranks) {}

  /// Whether nothing more is to be begun; `now`: since the session began [s]. Looks for signals, at
  /// the clock, and a few times per second at the other ranks.
  bool must_stop(double now);
  /// True for the one that comes first.
  bool is_because(Reason reason);
  void breaks() { reason_ = broken; }
  bool is_broken() const { return reason_ == broken; }
  bool has_come() const { return reason_ != none; }
  /// Lets the other ranks know. Of a time that is over they need not: each has a clock of its own.
  void tell_others();

  /// How the session ends; `defect` if it broke.
  ExitCode code(ExitCode defect) const;
  TimeForGroups& time() { return time_; }

 private:
  bool others_stopped(double now);

  StopSignals signals_;
  TimeForGroups time_;
  Ranks& ranks_;
  std::atomic<int> reason_ = none;
  std::atomic<double> looked_ = 0.0;  ///< at the other ranks, when [s]
};

}  // namespace drift::mc
