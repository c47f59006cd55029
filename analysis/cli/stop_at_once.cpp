#include "analysis/cli/stop_at_once.hpp"

#include <signal.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <iterator>

#include "mc/engine/stop_signals.hpp"

namespace drift::cli {
namespace {

const char* last_words = "";  // a signal handler reaches nothing but globals
std::array<struct sigaction, std::size(mc::stop_signals)> before{};

extern "C" void on_stop(int number) {
  if (::write(STDERR_FILENO, last_words, std::strlen(last_words)) < 0) {
    // Nobody listens; the program ends all the same.
  }
  ::_exit(128 + number);
}

}  // namespace

StopAtOnce::StopAtOnce(const char* words) {
  last_words = words;
  struct sigaction action {};
  action.sa_handler = on_stop;
  sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < std::size(mc::stop_signals); ++i) {
    ::sigaction(mc::stop_signals[i], nullptr, &before[i]);
    // What the parent chose to ignore (nohup) stays ignored.
    if (before[i].sa_handler != SIG_IGN) ::sigaction(mc::stop_signals[i], &action, nullptr);
  }
}

StopAtOnce::~StopAtOnce() {
  for (std::size_t i = 0; i < std::size(mc::stop_signals); ++i)
    ::sigaction(mc::stop_signals[i], &before[i], nullptr);
}

}  // namespace drift::cli
