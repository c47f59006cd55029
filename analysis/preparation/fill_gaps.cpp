#include "analysis/preparation/fill_gaps.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "analysis/preparation/input_thresholds.hpp"

namespace drift::preparation {
namespace {

bool measured(const Channel& c) {
  return c.name.starts_with("acc_") || c.name.starts_with("gimbal_");
}

class Gaps {
 public:
  Gaps(const Recording& r, double interval)
      : r_(r), time_(r.find("time")->values), interval_(interval) {}

  /// Rows that are missing before `row` and can be put there.
  std::size_t before(std::size_t row) const {
    if (row == 0) return 0;
    const double step = time_[row] - time_[row - 1];
    if (!(step > RecordingLimits::gap * interval_)) return 0;
    for (const Channel& c : r_.channels) {
      const double change = std::abs(c.values[row] - c.values[row - 1]);
      if ((c.name == "position" || c.name == "phase") && change != 0.0) return 0;
      if (c.name.starts_with("cmd_") && !(change < RecordingLimits::gap_command)) return 0;
    }
    const auto missing = static_cast<std::size_t>(std::lround(step / interval_) - 1);
    return missing <= RecordingLimits::longest_gap ? missing : 0;
  }

 private:
  const Recording& r_;
  const std::vector<double>& time_;
  double interval_;
};

}  // namespace

void fill_gaps(Recording& recording, double interval, std::vector<std::string>& remarks) {
  if (!(interval > 0.0) || recording.rows() < 2) return;
  const Gaps gaps(recording, interval);
  std::vector<std::size_t> missing(recording.rows());
  std::size_t filled = 0, count = 0, first = 0;
  for (std::size_t row = 0; row < missing.size(); ++row) {
    missing[row] = gaps.before(row);
    filled += missing[row];
    if (missing[row] > 0 && count++ == 0) first = row;
  }
  if (filled == 0) return;
  const std::size_t line = first < recording.lines.size() ? recording.lines[first] : first + 1;
  remarks.push_back(
      fmt::format("{}: {} rows are missing within positions, in {} gap{}, the first before line "
                  "{}: taken as not "
                  "measured, the command as held",
                  recording.source.empty() ? "recording" : recording.source, filled, count,
                  count == 1 ? "" : "s", line));
  const auto fill = [&](const auto& values, const auto& between) {
    std::decay_t<decltype(values)> out;
    out.reserve(values.size() + filled);
    for (std::size_t row = 0; row < values.size(); ++row) {
      for (std::size_t k = 1; k <= missing[row]; ++k)
        out.push_back(between(values[row - 1], values[row],
                              static_cast<double>(k) / static_cast<double>(missing[row] + 1)));
      out.push_back(values[row]);
    }
    return out;
  };
  for (Channel& c : recording.channels)
    c.values = fill(c.values, [&](double a, double b, double part) {
      return measured(c) ? std::numeric_limits<double>::quiet_NaN() : a + part * (b - a);
    });
  recording.lines = fill(recording.lines, [](std::size_t, std::size_t b, double) { return b; });
}

}  // namespace drift::preparation
