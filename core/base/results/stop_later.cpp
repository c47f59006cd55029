#include "core/base/results/stop_later.hpp"

#include <signal.h>

#include <atomic>

namespace drift {
namespace {

std::atomic<int> living{0};
std::atomic<int> waiting{0};  // the signal; a handler reaches nothing but globals

}  // namespace

StopLater::StopLater() {
  ++living;
}

StopLater::~StopLater() {
  if (--living > 0) return;
  if (const int signal = waiting.exchange(0)) ::raise(signal);
}

bool StopLater::holds(int signal) noexcept {
  // Noted before the look, as the last one looks for it after it is gone: none is lost between.
  waiting = signal;
  if (living > 0) return true;
  waiting = 0;
  return false;
}

}  // namespace drift
