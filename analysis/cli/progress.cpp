#include "analysis/cli/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
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

double seconds_since(Clock::time_point t) {
  return std::chrono::duration<double>(Clock::now() - t).count();
}

}  // namespace

std::string duration_text(double seconds) {
  if (!std::isfinite(seconds)) return "unknown";
  const auto s = static_cast<long long>(std::lround(seconds));
  if (s < 120) return fmt::format("{} s", s);
  if (s < 7200) return fmt::format("{} min {} s", s / 60, s % 60);
  return fmt::format("{} h {} min", s / 3600, s / 60 % 60);
}

void redraw_progress(const std::string& what, double done, const std::string& words,
                     LineEnd line_end) {
  constexpr std::size_t columns = 79, bar = 20;
  const double part = std::isfinite(done) ? std::clamp(done, 0.0, 1.0) : 1.0;
  const auto full = static_cast<std::size_t>(part * static_cast<double>(bar));
  const std::string line = fmt::format("{} [{}{}] {}", what, std::string(full, '#'),
                                       std::string(bar - full, '-'), words);
  // As long as any line before it, and no longer than the terminal.
  say("\r{:<{}.{}}{}", line, columns, columns, line_end == LineEnd::last ? "\n" : "");
}

bool progress_is_redrawn(const std::string& style) {
  return style == "auto" && isatty(STDERR_FILENO) != 0;
}

std::function<void(std::size_t, std::size_t)> progress_reporter(const std::string& style,
                                                                const std::string& what) {
  if (style == "none") return {};
  const bool redraw = progress_is_redrawn(style), json = style == "json";
  auto state = std::make_shared<State>();
  return [=](std::size_t done, std::size_t total) {
    const std::scoped_lock lock(state->guard);
    if (done <= state->shown) return;  // threads may report out of order
    state->shown = done;
    const double elapsed = seconds_since(state->started);
    const double rate = elapsed > 0.0 ? static_cast<double>(done) / elapsed : 0.0;
    const double left = static_cast<double>(total - done) / rate;
    if (json) {
      say_json(fmt::format(
          "{{\"what\":\"{}\",\"done\":{},\"total\":{},\"elapsed_s\":{:.1f},\"eta_s\":{}}}", what,
          done, total, elapsed, std::isfinite(left) ? fmt::format("{:.1f}", left) : "null"));
    } else if (redraw) {
      redraw_progress(what, static_cast<double>(done) / static_cast<double>(total),
                      fmt::format("{}/{}, {:.3g}/s, {}", done, total, rate,
                                  done == total ? "took " + duration_text(elapsed)
                                                : duration_text(left) + " left"),
                      done == total ? LineEnd::last : LineEnd::redrawn);
    } else if (done == total || seconds_since(state->last) > plain_interval) {
      say("{}: {}/{} in {:.1f} s\n", what, done, total, elapsed);
      state->last = Clock::now();
    }
  };
}

std::function<void(const std::string&, double)> stage_reporter(const std::string& style,
                                                               const std::string& what) {
  if (style == "none") return {};
  const bool redraw = progress_is_redrawn(style), json = style == "json";
  auto state = std::make_shared<State>();
  auto stage = std::make_shared<std::string>();
  return [=](const std::string& name, double done) {
    const std::scoped_lock lock(state->guard);
    const auto percent = static_cast<std::size_t>(100.0 * done);
    const bool next = name != *stage;
    if (percent < state->shown || (percent == state->shown && !next)) return;
    state->shown = percent;
    *stage = name;
    const double elapsed = seconds_since(state->started);
    const bool known = done > 0.02, over = percent >= 100;
    const double left = known ? elapsed * (1.0 - done) / done : 0.0;
    if (json) {
      say_json(fmt::format(
          "{{\"what\":\"{}\",\"stage\":\"{}\",\"done\":{:.3f},\"elapsed_s\":{:.1f},\"eta_s\":{}}}",
          what, name, done, elapsed, known ? fmt::format("{:.1f}", left) : "null"));
    } else if (redraw) {
      redraw_progress(what, done,
                      over ? fmt::format("took {}", duration_text(elapsed))
                           : fmt::format("{} %, {}{}", percent, name,
                                         known ? ", " + duration_text(left) + " left" : ""),
                      over ? LineEnd::last : LineEnd::redrawn);
    } else if (next || over || seconds_since(state->last) > plain_interval) {
      say("{}: {}, {} % in {:.1f} s{}\n", what, name, percent, elapsed,
          known && !over ? fmt::format(", {:.0f} s left", left) : "");
      state->last = Clock::now();
    }
  };
}

}  // namespace drift::cli
