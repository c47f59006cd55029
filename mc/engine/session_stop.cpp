#include "mc/engine/session_stop.hpp"

namespace drift::mc {

bool SessionStop::must_stop(double now) {
  if (reason_ != none) return true;
  if (signals_.caught() != 0) {
    is_because(asked);
  } else if (time_.is_over(now)) {
    is_because(full_time);
  } else if (others_stopped(now)) {
    is_because(elsewhere);
  }
  return reason_ != none;
}

bool SessionStop::is_because(Reason reason) {
  int expected = none;
  return reason_.compare_exchange_strong(expected, reason);
}

void SessionStop::tell_others() {
  const int reason = reason_;
  if (reason == asked || reason == failed_run || reason == broken)
    ranks_.add(Ranks::Counter::stop, 1);
}

bool SessionStop::others_stopped(double now) {
  constexpr double interval = 0.2;  // [s] each look is a message to the leader
  if (ranks_.size() == 1) return false;
  double looked = looked_;
  return now - looked >= interval && looked_.compare_exchange_strong(looked, now) &&
         ranks_.add(Ranks::Counter::stop, 0) > 0;
}

ExitCode SessionStop::code(ExitCode defect) const {
  switch (reason_) {
    case asked:
      return code_of_stop(signals_.caught());
    case full_time:
      return ExitCode::wall_time;
    case failed_run:
      return ExitCode::failed_runs;
    case broken:
      return defect;
    default:
      return ExitCode::ok;
  }
}

}  // namespace drift::mc
