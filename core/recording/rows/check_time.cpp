#include "core/recording/rows/check_time.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/recording/own/clock.hpp"
#include "core/recording/rows/held_order.hpp"

namespace drift {
namespace {

constexpr double clock_day = 86400.0;  // [s]

/// Whether so many rows have the time of the row before that none was written twice: the time is
/// too coarse. Said once.
bool report_shared_times(const Recording& r, const Channel& time, Problems& problems) {
  constexpr std::size_t few = 10;  // rows that may have been written twice, however short the log
  constexpr double many = 0.25;    // of all rows: every second one shares a minute at 30 s
  std::size_t shared = 0, first = 0;
  for (std::size_t i = 1; i < r.rows(); ++i)
    if (time.values[i] == time.values[i - 1] && ++shared == 1) first = i;
  if (shared < few || static_cast<double>(shared) < many * static_cast<double>(r.rows()))
    return false;
  problems.add(
      place_in(r, first, "time"),
      fmt::format("{} s repeats {} s at {}, and so do the times of {} of {} rows",
                  time.values[first], time.values[first], line_of(r, first - 1), shared, r.rows()),
      "times that tell the rows apart",
      "Log finer times (seconds, where minutes are written): as coarse as these they are read only "
      "where rows are evenly spaced and none is lost or written twice");
  return true;
}

/// Whether the time steps back as a clock of 12 hours without AM and PM does at one o'clock,
/// whatever else is wrong with it. Said once.
bool report_twelve_hours(const Recording& r, const Channel& time, Problems& problems) {
  const auto zero = std::ranges::find(r.facts, "time_zero", [](const auto& f) { return f.first; });
  const auto clock = zero == r.facts.end() ? std::nullopt : parse_clock(zero->second);
  const auto hour = [&](double t) { return std::floor(std::fmod(*clock + t, clock_day) / 3600.0); };
  for (std::size_t i = 1; clock && i < r.rows(); ++i) {
    const double before = time.values[i - 1], after = time.values[i];
    if (!(after < before) || hour(before) != 12.0 || hour(after) != 1.0) continue;
    problems.add(place_in(r, i, "time"),
                 fmt::format("{} s comes after {} s at {}", after, before, line_of(r, i - 1)),
                 "time to increase from row to row",
                 "This seems to be a clock of 12 hours, at one o'clock: write AM or PM behind the "
                 "times, or hours from 0 to 23 (13:00 after 12:59)");
    return true;
  }
  return false;
}

}  // namespace

std::size_t line_of(const Recording& r, std::size_t row) {
  return row < r.lines.size() ? r.lines[row] : row + 1;
}

void number_rows(Recording& r, std::size_t rows) {
  if (!r.lines.empty()) return;
  r.lines.resize(rows);
  std::iota(r.lines.begin(), r.lines.end(), 1);
}

std::string place_in(const Recording& r, std::size_t row, std::string_view column) {
  return fmt::format("{}:{}", line_of(r, row), column);
}

std::optional<double> begins_again_after(double before, double after) {
  constexpr double week = 604800.0, hour = 3600.0;
  for (const double period : {clock_day, week})
    if (before <= period && before > period - hour && after >= 0.0 && after < hour) return period;
  return std::nullopt;
}

void check_time(const Recording& r, Problems& problems) {
  const Channel* time = r.find("time");
  if (!time || report_twelve_hours(r, *time, problems) || report_shared_times(r, *time, problems))
    return;
  double last = -HUGE_VAL;
  std::size_t last_row = 0;
  for (std::size_t i = 0; i < r.rows(); ++i) {
    const double t = time->values[i];
    if (std::isnan(t)) {
      problems.add(place_in(r, i, "time"), "the time is missing", "a number in every row",
                   "Give the time");
    } else if (!(t > last)) {
      const auto begins_again = begins_again_after(last, t);
      problems.add(
          place_in(r, i, "time"),
          fmt::format("{} s {} {} s at {}", t, t == last ? "repeats" : "comes after", last,
                      line_of(r, last_row)),
          "time to increase from row to row",
          begins_again
              ? fmt::format(
                    "If this is a clock that begins again {}, read it as a counter in "
                    "[recording] of the study file: counter = \"its header\", tick = \"1 "
                    "ms\" and wrap = {:.0f}, or what a count is, and how many make a {}",
                    *begins_again > clock_day ? "with the week, as that of GPS" : "at midnight",
                    1e3 * *begins_again, *begins_again > clock_day ? "week" : "day")
              : "Remove rows that were written twice; if a clock begins again here (in each "
                "position, in autumn, where a counter is full), write times that go on, or "
                "read it as a counter of [recording]; sort only rows that are out of order");
      if (begins_again) last = -HUGE_VAL;  // said once
    }
    if (t > last) {
      last = t;
      last_row = i;
    }
  }
}

void check_position(const Recording& r, RowOrder order, Problems& problems) {
  const Channel* position = r.find("position");
  if (!position) return;
  double last = 1.0;
  for (std::size_t i = 0; i < r.rows(); ++i) {
    const double p = position->values[i];
    if (!(p >= 1.0 && p <= 1e9) || p != std::floor(p)) {
      problems.add(place_in(r, i, "position"),
                   std::isnan(p) ? "no position is given" : fmt::format("the position is {}", p),
                   "a whole number from 1 on",
                   "Give the number of the plan's position, or say in [recording] of the study "
                   "file which is which: positions = { \"NUMBER IN THE FILE\" = NUMBER IN THE "
                   "PLAN, ... }, 0 where it is turned between two positions");
    } else if (p < last && order == RowOrder::known) {
      problems.add(place_in(r, i, "position"), fmt::format("position {} comes after {}", p, last),
                   "positions in the order of the plan", held_order_advice(position->values));
    } else {
      last = p;
    }
  }
}

void check_phase(const Recording& r, Problems& problems) {
  const Channel* phase = r.find("phase");
  if (!phase) return;
  for (std::size_t i = 0; i < r.rows(); ++i)
    if (const double p = phase->values[i]; !(p == 0.0 || p == 1.0))
      problems.add(place_in(r, i, "phase"), fmt::format("the phase is {}", p),
                   "0 (dwell) or 1 (slew)", "Correct the phase");
}

}  // namespace drift
