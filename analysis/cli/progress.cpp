#include "analysis/cli/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <mutex>

namespace drift::cli {
namespace {

using Clock = std::chrono::steady_clock;

struct State {
  std::mutex guard;
  Clock::time_point started = Clock::now();
  Clock::time_point last = {};
  std::size_t shown = 0;
};

constexpr double plain_interval = 10.0;  // [s]

}  // namespace

std::function<void(std::size_t, std::size_t)> progress_reporter(const std::string& style,
                                                                const std::string& what) {
  if (style == "none") return {};
  const bool redraw = style == "auto" && isatty(STDERR_FILENO);
  const bool json = style == "json";
  auto state = std::make_shared<State>();
  return [=](std::size_t done, std::size_t total) {
    const std::scoped_lock lock(state->guard);
    if (done <= state->shown) return;  // threads may report out of order
    state->shown = done;
    const auto now = Clock::now();
    const double elapsed = std::chrono::duration<double>(now - state->started).count();
    const double since = std::chrono::duration<double>(now - state->last).count();
    const double left = elapsed * static_cast<double>(total - done) / static_cast<double>(done);
    if (json) {
      fmt::print(stderr, "{{\"what\":\"{}\",\"done\":{},\"total\":{},\"elapsed_s\":{:.1f},\"eta_s\":{:.1f}}}\n",
                 what, done, total, elapsed, left);
    } else if (redraw) {
      fmt::print(stderr, "\r{}: {}/{}, {:.0f} s left {}", what, done, total, left, done == total ? "\n" : "");
    } else if (done == total || since > plain_interval) {
      fmt::print(stderr, "{}: {}/{} in {:.1f} s\n", what, done, total, elapsed);
      state->last = now;
    }
  };
}

}  // namespace drift::cli
