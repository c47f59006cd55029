#include "analysis/cli/run_progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "analysis/cli/print.hpp"
#include "analysis/cli/progress.hpp"

namespace drift::cli {
namespace {

constexpr double json_interval = 1.0;  // [s]

}  // namespace

std::string duration_text(double seconds) {
  if (!std::isfinite(seconds)) return "unknown";
  const auto s = static_cast<long long>(std::lround(seconds));
  if (s < 120) return fmt::format("{} s", s);
  if (s < 7200) return fmt::format("{} min {} s", s / 60, s % 60);
  return fmt::format("{} h {} min", s / 3600, s / 60 % 60);
}

mc::ProgressSink run_progress(const std::string& style) {
  if (style == "none") return {};
  const bool redraw = style == "auto" && isatty(STDERR_FILENO);
  const bool json = style == "json";
  const double interval = redraw ? 0.0 : json ? json_interval : plain_interval;
  // The first line comes after one interval: a study of a moment needs none.
  return [=, last = std::make_shared<double>(0.0),
          said_all = std::make_shared<bool>(false)](const mc::Progress& p) {
    const bool complete = p.done >= p.total;
    if (*said_all || (!complete && p.elapsed - *last < interval)) return;
    *last = p.elapsed;
    *said_all = complete;
    const double rate = p.elapsed > 0.0 ? static_cast<double>(p.done_now) / p.elapsed : 0.0;
    const double left = complete ? 0.0 : static_cast<double>(p.total - p.done) / rate;
    if (json) {
      const std::string eta = std::isfinite(left) ? fmt::format("{:.1f}", left) : "null";
      say("{{\"done\":{},\"total\":{},\"failed\":{},\"runs_per_s\":{:.2f},\"elapsed_s\":{:."
          "1f},\"eta_s\":{}}}\n",
          p.done, p.total, p.failed, rate, p.elapsed, eta);
      return;
    }
    const std::string line =
        fmt::format("{}/{} runs, {} failed, {:.1f} runs/s, {}", p.done, p.total, p.failed, rate,
                    complete ? "took " + duration_text(p.elapsed) : duration_text(left) + " left");
    if (redraw) {
      say("\r{:<76}{}", line, complete ? "\n" : "");
    } else {
      say("{}\n", line);
    }
  };
}

}  // namespace drift::cli
