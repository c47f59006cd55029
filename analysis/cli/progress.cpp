#include "analysis/cli/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <mutex>

#include "analysis/cli/print.hpp"

namespace drift::cli {
namespace {

using Clock = std::chrono::steady_clock;

struct State {
  std::mutex guard;
  Clock::time_point started = Clock::now();
  Clock::time_point last = {};
  std::size_t shown = 0;
};

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
      say("{{\"what\":\"{}\",\"done\":{},\"total\":{},\"elapsed_s\":{:.1f},\"eta_s\":{:.1f}}}\n",
          what, done, total, elapsed, left);
    } else if (redraw) {
      say("\r{}: {}/{}, {:.0f} s left {}", what, done, total, left, done == total ? "\n" : "");
    } else if (done == total || since > plain_interval) {
      say("{}: {}/{} in {:.1f} s\n", what, done, total, elapsed);
      state->last = now;
    }
  };
}

std::function<void(const std::string&, double)> stage_reporter(const std::string& style,
                                                               const std::string& what) {
  if (style == "none") return {};
  const bool redraw = style == "auto" && isatty(STDERR_FILENO);
  const bool json = style == "json";
  auto state = std::make_shared<State>();
  auto stage = std::make_shared<std::string>();
  return [=](const std::string& name, double done) {
    const std::scoped_lock lock(state->guard);
    const auto percent = static_cast<std::size_t>(100.0 * done);
    const bool next = name != *stage;
    if (percent < state->shown || (percent == state->shown && !next)) return;
    state->shown = percent;
    *stage = name;
    const auto now = Clock::now();
    const double elapsed = std::chrono::duration<double>(now - state->started).count();
    const double since = std::chrono::duration<double>(now - state->last).count();
    const bool known = done > 0.02, over = percent >= 100;
    const double left = known ? elapsed * (1.0 - done) / done : 0.0;
    if (json) {
      say("{{\"what\":\"{}\",\"stage\":\"{}\",\"done\":{:.3f},\"elapsed_s\":{:.1f},\"eta_"
          "s\":{}}}\n",
          what, name, done, elapsed, known ? fmt::format("{:.1f}", left) : "null");
    } else if (redraw) {
      say("\r{}: {}, {} %, {:.0f} s, {}          {}", what, name, percent, elapsed,
          known ? fmt::format("{:.0f} s left", left) : "", over ? "\n" : "");
    } else if (next || over || since > plain_interval) {
      say("{}: {}, {} % in {:.1f} s{}\n", what, name, percent, elapsed,
          known && !over ? fmt::format(", {:.0f} s left", left) : "");
      state->last = now;
    }
  };
}

}  // namespace drift::cli
