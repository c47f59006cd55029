#include "mc/engine/stop_signals.hpp"

#include <signal.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <iterator>

#include "core/base/results/stop_later.hpp"
#include "core/base/temporary_file.hpp"

namespace drift::mc {
namespace {

std::atomic<int> first_caught{0};  // a signal handler reaches nothing but globals
std::array<struct sigaction, std::size(stop_signals)> before{};

extern "C" void on_signal(int number) {
  int none = 0;
  if (first_caught.compare_exchange_strong(none, number) || StopLater::holds(number)) return;
  remove_own_temporaries();
  _exit(static_cast<int>(code_of_stop(number)));
}

}  // namespace

StopSignals::StopSignals() {
  first_caught = 0;
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < std::size(stop_signals); ++i) {
    sigaction(stop_signals[i], nullptr, &before[i]);
    // What the parent chose to ignore (nohup) stays ignored.
    if (before[i].sa_handler != SIG_IGN) sigaction(stop_signals[i], &action, nullptr);
  }
}

StopSignals::~StopSignals() {
  for (std::size_t i = 0; i < std::size(stop_signals); ++i)
    sigaction(stop_signals[i], &before[i], nullptr);
}

int StopSignals::caught() const {
  return first_caught;
}

}  // namespace drift::mc
