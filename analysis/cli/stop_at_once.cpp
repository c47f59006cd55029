#include "analysis/cli/stop_at_once.hpp"

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <iterator>

#include "analysis/cli/print.hpp"
#include "core/base/results/stop_later.hpp"
#include "core/base/temporary_file.hpp"
#include "mc/engine/stop_signals.hpp"

namespace drift::cli {
namespace {

// A signal handler reaches nothing but globals. Words are written where it does not look.
constexpr std::size_t room = 8192;  // the longest path, and words
std::array<std::array<char, room>, 2> texts{};
std::atomic<int> said{0};
std::array<struct sigaction, std::size(mc::stop_signals)> handlers_before{};
int living = 0;

void write_words(const char* words) {
  if (::write(STDERR_FILENO, words, std::strlen(words)) < 0) {
    // Nobody listens; the program ends all the same.
  }
}

extern "C" void on_stop(int number) {
  if (StopLater::holds(number)) return;
  if (line_is_open() != 0) write_words("\n");
  write_words(texts[static_cast<std::size_t>(said.load())].data());
  remove_own_temporaries();
  ::_exit(static_cast<int>(mc::code_of_stop(number)));
}

/// What the handler is to write from here on.
void put(std::string_view line) {
  const int other = 1 - said.load();
  auto& text = texts[static_cast<std::size_t>(other)];
  const std::string_view kept = line.substr(0, room - 1);
  *std::copy(kept.begin(), kept.end(), text.begin()) = '\0';
  said = other;
}

void install() {
  struct sigaction action {};
  action.sa_handler = on_stop;
  sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < std::size(mc::stop_signals); ++i) {
    ::sigaction(mc::stop_signals[i], nullptr, &handlers_before[i]);
    // What the parent chose to ignore (nohup) stays ignored.
    if (handlers_before[i].sa_handler != SIG_IGN)
      ::sigaction(mc::stop_signals[i], &action, nullptr);
  }
}

}  // namespace

StopAtOnce::StopAtOnce(std::string_view words)
    : before_(texts[static_cast<std::size_t>(said.load())].data()) {
  say(words);
  if (living++ == 0) install();
}

void StopAtOnce::say(std::string_view words) {
  put(note_line(words));
}

StopAtOnce::~StopAtOnce() {
  put(before_);
  if (--living > 0) return;
  for (std::size_t i = 0; i < std::size(mc::stop_signals); ++i)
    ::sigaction(mc::stop_signals[i], &handlers_before[i], nullptr);
}

}  // namespace drift::cli
