#include "core/recording/own/guess_time.hpp"

#include <algorithm>
#include <cmath>

#include "core/recording/own/clock.hpp"
#include "core/recording/own/csv_cells.hpp"
#include "core/recording/own/recording_unit.hpp"
#include "core/recording/recording_check.hpp"

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
  if (!holds_times_of_day(*time)) return;
  // A date that stays one past midnight is that of the file: the clock goes on without it.
  const auto date = [](const GuessedColumn& c) {
    return c.channel.empty() && c.words.size() > 1 && holds_dates(c);
  };
  if (std::ranges::count_if(file.columns, date) == 1)
    file.format.date = std::ranges::find_if(file.columns, date)->header.name;
}

void count_clock_of_numbers(GuessedFile& file) {
  for (GuessedColumn& c : file.columns) {
    const auto unit = c.channel == "time" ? parse_recording_unit(c.unit) : std::nullopt;
    if (!unit || c.back.first == c.back.second ||
        !begins_again_at_midnight(c.back.first * unit->to_si, c.back.second * unit->to_si))
      continue;
    constexpr double day = 86400.0;  // [s]
    file.format.counter = c.header.name;
    file.format.tick = unit->to_si;
    file.format.wrap = std::round(day / unit->to_si);
    c.channel.clear();
    c.unit.clear();
  }
}

}  // namespace drift
