#include "core/recording/own/guess_time.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/recording/own/clock.hpp"
#include "core/recording/own/csv_cells.hpp"
#include "core/recording/own/guess_values.hpp"
#include "core/recording/own/recording_unit.hpp"
#include "core/recording/rows/check_time.hpp"

namespace drift {
namespace {

/// Whether all texts of a column are something, the day or the month first in all of them.
template <class Is>
bool all_words(const GuessedColumn& c, Is&& is) {
  const auto all = [&](StrokeDates order) {
    return std::ranges::all_of(c.words, [&](const std::string& text) { return is(text, order); });
  };
  return c.numbers == 0 && !c.words.empty() &&
         (all(StrokeDates::day_first) || all(StrokeDates::month_first));
}

/// Times of day alone: a date may stand before them.
bool holds_times_of_day(const GuessedColumn& c) {
  return all_words(c, [](const std::string& text, StrokeDates) {
    return parse_clock("2000-01-01 " + text).has_value();
  });
}

/// Dates as numbers, 20260301. Low and high are looked at, which of other whole numbers are hardly
/// both a date.
bool holds_dates_of_numbers(const GuessedColumn& c) {
  return c.numbers > 0 && c.texts == 0 && c.whole && !c.header.unit &&
         is_date(fmt::format("{:.0f}", c.low)) && is_date(fmt::format("{:.0f}", c.high));
}

/// "130510" in all cells: of other numbers of six digits 64 in 100 are no such time, as those that
/// go on by one are after a minute.
bool holds_basic_times(const GuessedColumn& c) {
  constexpr std::size_t enough = 10;
  return c.numbers >= enough && c.texts == 0 && c.basic_times && !stated_unit(c);
}

/// "T" without a unit may be anything.
bool is_bare_symbol(const GuessedColumn& c) {
  return c.header.name.size() == 1 && c.numbers > 0 && !c.header.unit;
}

}  // namespace

bool holds_dates(const GuessedColumn& c) {
  return all_words(c, is_date);
}

bool holds_times(const GuessedColumn& c) {
  return all_words(c, [](const std::string& text, StrokeDates order) {
    return parse_clock(text, order).has_value();
  });
}

void guess_counter(GuessedFile& file) {
  if (std::ranges::find(file.columns, "time", &GuessedColumn::channel) != file.columns.end())
    return;
  for (const GuessedColumn& c : file.columns) {
    const bool xsens = c.header.name == "SampleTimeFine";  // 10 kHz in 32 bits
    if (!c.channel.empty() || (!xsens && lower_case(c.header.name) != "counter")) continue;
    (xsens ? file.format.counter : file.counter) = c.header.name;
    if (xsens) {
      file.format.tick = 1e-4;
      file.format.wrap = 4294967296.0;
    }
    return;
  }
}

void name_time_by_values(GuessedFile& file) {
  if (!file.counter.empty() || !file.format.counter.empty()) return;
  auto time = std::ranges::find(file.columns, "time", &GuessedColumn::channel);
  const bool none = time == file.columns.end();
  const auto clock = [](const GuessedColumn& c) {
    return c.channel.empty() && c.words.size() > 1 && holds_times(c);
  };
  if (none || is_bare_symbol(*time)) {
    const bool one = std::ranges::count_if(file.columns, clock) == 1;
    if (none && !one) return;
    if (!none && one) time->channel.clear();
    if (one) time = std::ranges::find_if(file.columns, clock);
    time->channel = "time";
  }
  const bool basic = holds_basic_times(*time);
  if (!basic && !holds_times_of_day(*time)) return;
  // A date that stays one past midnight is that of the file: the clock goes on without it, unless
  // it is a number alone.
  const auto date = [&](const GuessedColumn& c) {
    const bool changes = c.words.size() > 1 || c.high > c.low;
    return c.channel.empty() && (basic || changes) && (holds_dates(c) || holds_dates_of_numbers(c));
  };
  if (std::ranges::count_if(file.columns, date) != 1) return;
  file.format.date = std::ranges::find_if(file.columns, date)->header.name;
  time->needs_date = basic;
}

void count_clock_of_numbers(GuessedFile& file) {
  for (GuessedColumn& c : file.columns) {
    const auto unit = c.channel == "time" ? parse_recording_unit(c.unit) : std::nullopt;
    const auto period =
        unit && c.back.first != c.back.second
            ? begins_again_after(c.back.first * unit->to_si, c.back.second * unit->to_si)
            : std::nullopt;
    if (!period) continue;
    file.format.counter = c.header.name;
    file.format.tick = unit->to_si;
    file.format.wrap = std::round(*period / unit->to_si);
    c.channel.clear();
    c.unit.clear();
  }
}

}  // namespace drift
