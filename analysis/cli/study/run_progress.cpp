#include "analysis/cli/study/run_progress.hpp"

#include <fmt/format.h>

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

mc::ProgressSink run_progress(const std::string& style) {
  if (style == "none") return {};
  const bool redraw = progress_is_redrawn(style);
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
      say_json(fmt::format(
          "{{\"done\":{},\"total\":{},\"failed\":{},\"runs_per_s\":{:.2f},\"elapsed_s\":{:.1f},"
          "\"eta_s\":{},\"at_most\":{}}}",
          p.done, p.total, p.failed, rate, p.elapsed, eta, p.at_most));
      return;
    }
    const std::string line = fmt::format(
        "{}{}{} runs, {} failed, {:.1f} runs/s, {}", p.done, p.at_most ? " of at most " : "/",
        p.total, p.failed, rate,
        complete ? "took " + duration_text(p.elapsed)
                 : fmt::format("{}{} left", p.at_most ? "at most " : "", duration_text(left)));
    if (redraw) {
      redraw_progress("run", static_cast<double>(p.done) / static_cast<double>(p.total), line,
                      complete ? LineEnd::last : LineEnd::redrawn);
    } else {
      say("{}\n", line);
    }
  };
}

}  // namespace drift::cli
