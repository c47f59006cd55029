#include "core/recording/own/clock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <utility>

#include "core/recording/own/csv_cells.hpp"
#include "core/recording/recording_problems.hpp"

namespace drift {
namespace {

constexpr double day_s = 86400.0;

/// A number from the front of a text, which then is what follows it; as from_chars reads.
template <class T>
bool take_number(std::string_view& text, T& value) {
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return false;
  text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
  return true;
}

bool take(std::string_view& text, char c) {
  if (!text.starts_with(c)) return false;
  text.remove_prefix(1);
  return true;
}

/// "13:05:10.25", "01:05:10.25 PM", "13:05" or "13.05.10" from the front of a text; "13.05" is a
/// number.
std::optional<double> take_time_of_day(std::string_view& text) {
  int hour = 0, minute = 0;
  double second = 0.0;
  if (text.empty() || text.front() < '0' || text.front() > '9') return std::nullopt;
  if (!take_number(text, hour)) return std::nullopt;
  const char mark = text.starts_with('.') ? '.' : ':';
  if (!take(text, mark) || !take_number(text, minute)) return std::nullopt;
  const bool seconds = take(text, mark);
  if (seconds ? !take_number(text, second) : mark == '.') return std::nullopt;
  const std::string half = lower_case(trimmed(text).substr(0, 2));
  if (half == "am" || half == "pm") {
    if (hour < 1 || hour > 12) return std::nullopt;
    hour = hour % 12 + (half == "pm" ? 12 : 0);
    text = trimmed(text).substr(2);
  }
  const bool end_of_day = hour == 24 && minute == 0 && second == 0.0;  // ISO 8601
  if (!end_of_day &&
      !(hour >= 0 && hour < 24 && minute >= 0 && minute < 60 && second >= 0.0 && second < 61.0))
    return std::nullopt;
  return 3600.0 * hour + 60.0 * minute + second;
}

/// "130510" or "130510.25" from the front of a text, as ISO 8601 has it behind a date.
std::optional<double> take_basic_time(std::string_view& text) {
  constexpr std::size_t digits = 6;
  const std::size_t end = std::min(text.find_first_not_of("0123456789"), text.size());
  std::string_view rest = text;
  double number = 0.0;
  if (end != digits || !take_number(rest, number)) return std::nullopt;
  const double hour = std::floor(number / 1e4), minute = std::floor(number / 1e2) - 1e2 * hour,
               second = number - 1e4 * hour - 1e2 * minute;
  if (hour > 23.0 || minute > 59.0 || !(second < 61.0)) return std::nullopt;
  text = rest;
  return 3600.0 * hour + 60.0 * minute + second;
}

/// "Mar", "MAR." or "March" from the front of a text, in English or German; 0 if it is none.
int take_month_name(std::string_view& text) {
  constexpr std::array<std::array<std::string_view, 2>, 12> names{{{"jan", "jan"},
                                                                   {"feb", "feb"},
                                                                   {"mar", "m\u00e4r"},
                                                                   {"apr", "apr"},
                                                                   {"may", "mai"},
                                                                   {"jun", "jun"},
                                                                   {"jul", "jul"},
                                                                   {"aug", "aug"},
                                                                   {"sep", "sep"},
                                                                   {"oct", "okt"},
                                                                   {"nov", "nov"},
                                                                   {"dec", "dez"}}};
  const std::size_t end = std::min(text.find_first_of("-./ 0123456789"), text.size());
  const std::string word = lower_case(text.substr(0, end));
  for (std::size_t k = 0; k < names.size(); ++k)
    if (word.starts_with(names[k][0]) || word.starts_with(names[k][1])) {
      text.remove_prefix(end);
      if (text.starts_with(". ")) text.remove_prefix(1);
      return static_cast<int>(k + 1);
    }
  return 0;
}

double seconds_of(std::chrono::year_month_day date) {
  return day_s * static_cast<double>(std::chrono::sys_days(date).time_since_epoch().count());
}

/// "14-Mar-2026" or "14 March 2026": what follows the day.
std::optional<double> take_rest_of_named_date(std::string_view& text, int first) {
  const char mark = text.front();
  std::string_view rest = text.substr(1);
  if (mark == '.' && rest.starts_with(' ')) rest.remove_prefix(1);
  const int month = take_month_name(rest);
  int last = 0;
  if (month == 0 || rest.empty() || std::string_view("-./ ").find(rest.front()) == rest.npos)
    return std::nullopt;
  rest.remove_prefix(1);
  if (!take_number(rest, last)) return std::nullopt;
  const std::chrono::year_month_day date{std::chrono::year(last), std::chrono::month(month),
                                         std::chrono::day(first)};
  if (first < 1 || last < 1000 || !date.ok()) return std::nullopt;
  text = rest;
  return seconds_of(date);
}

/// "20260301" of the centuries in which anything is logged; empty if the number is none.
std::optional<double> basic_date(int number) {
  const std::chrono::year_month_day date{
      std::chrono::year(number / 10000),
      std::chrono::month(static_cast<unsigned>(number / 100 % 100)),
      std::chrono::day(static_cast<unsigned>(number % 100))};
  if (number < 19000101 || number > 21991231 || !date.ok()) return std::nullopt;
  return seconds_of(date);
}

/// "2026-03-01", "20260301", "01.03.2026", "01/03/2026", "03-01-2026" or "01-Mar-2026" from the
/// front of a text, as seconds since 1970.
std::optional<double> take_date(std::string_view& text, StrokeDates order) {
  int first = 0, month = 0, last = 0;
  if (!take_number(text, first)) return std::nullopt;
  if (const auto basic = basic_date(first)) return basic;
  const char mark = text.empty() ? '\0' : text.front();
  if (mark != '\0' && std::string_view("-./ ").find(mark) != std::string_view::npos)
    if (const auto named = take_rest_of_named_date(text, first)) return named;
  if ((mark != '-' && mark != '.' && mark != '/') || !take(text, mark) ||
      !take_number(text, month) || !take(text, mark) || !take_number(text, last))
    return std::nullopt;
  if (mark != '.' && first < 1000 && order == StrokeDates::month_first) std::swap(first, month);
  const bool year_first = first >= 1000;
  using namespace std::chrono;
  const year_month_day date{year(year_first ? first : last), std::chrono::month(month),
                            day(year_first ? last : first)};
  if (!date.ok()) return std::nullopt;
  return seconds_of(date);
}

/// "Z", "+02:00" or nothing: what is to be taken off to come to UTC [s].
std::optional<double> zone_of(std::string_view text) {
  if (text.empty() || text == "Z" || text == "UTC") return 0.0;
  const double sign = text.front() == '-' ? -1.0 : 1.0;
  if (text.front() != '+' && text.front() != '-') return std::nullopt;
  text.remove_prefix(1);
  int hours = 0, minutes = 0;
  if (!take_number(text, hours)) return std::nullopt;
  if (hours > 99) {
    minutes = hours % 100;
    hours /= 100;
  } else if (take(text, ':') && !take_number(text, minutes)) {
    return std::nullopt;
  }
  if (!text.empty() || hours > 14 || minutes > 59) return std::nullopt;
  return sign * (3600.0 * hours + 60.0 * minutes);
}

}  // namespace

std::optional<double> parse_clock(std::string_view whole, StrokeDates order) {
  std::string text(trimmed(whole));
  if (const auto comma = text.find(','); comma != std::string::npos) text[comma] = '.';
  std::string_view rest = text;
  if (const auto of_day = take_time_of_day(rest)) {
    if (rest.empty()) return of_day;
    const auto whole_time = std::string_view(text).substr(0, text.size() - rest.size());
    const auto zone = zone_of(trimmed(rest));  // behind seconds: "08:30-09:00" is no time
    if (zone && std::ranges::count(whole_time, ':') == 2) return *of_day - *zone;
  }
  rest = text;
  const auto date = take_date(rest, order);
  if (!date || rest.empty()) return std::nullopt;
  if (rest.front() != 'T' && rest.front() != ' ' && rest.front() != '_') return std::nullopt;
  rest.remove_prefix(1);
  const auto basic = take_basic_time(rest);
  const auto of_day = basic ? basic : take_time_of_day(rest);
  const auto zone = of_day ? zone_of(trimmed(rest)) : std::nullopt;
  if (!zone) return std::nullopt;
  return *date + *of_day - *zone;
}

bool is_date(std::string_view text, StrokeDates order) {
  text = trimmed(text);
  return take_date(text, order) && text.empty();
}

/// A date that comes late makes the time go back by less than a day, or by a day where minutes are
/// all that is written; so does the right one behind a
/// date that came too early, by a day and more: that is left for others to refuse.
void Clock::Reading::take_late_date(double& now) {
  const double step = now - *last;
  if (step >= day_s) {
    ahead = true;
  } else if (step >= 0.0) {
    ahead = ahead && std::floor(now / day_s) == std::floor(*last / day_s);
  } else if (step < -0.5 * day_s && step + day_s >= 0.0 && !ahead) {
    now += day_s;
    ++late;
  }
}

std::optional<double> Clock::Reading::advance(std::string_view cell, bool dates_apart) {
  auto now = parse_clock(cell, order);
  if (!now) return std::nullopt;
  if (!first) first = now;
  if (last && dates_apart) take_late_date(*now);
  // A time of day begins again at midnight.
  if (last && *now < 2.0 * day_s && *now + 0.5 * day_s < *last) midnights += day_s;
  last = now;
  return *now + midnights - *first;
}

std::optional<double> Clock::read(std::string_view cell) {
  std::vector<std::pair<Reading, double>> next;
  for (Reading r : readings_)
    if (const auto seconds = r.advance(cell, dates_apart_)) next.emplace_back(r, *seconds);
  if (next.empty()) return std::nullopt;
  if (next.size() > 1 && next[0].second != next[1].second) {
    const auto step = [&](std::size_t i) { return std::abs(next[i].second - seconds_); };
    next.erase(next.begin() + (step(0) <= step(1) ? 1 : 0));
    decided_ = cell;
  }
  readings_.clear();
  for (const auto& [reading, seconds] : next) readings_.push_back(reading);
  if (zero_.empty()) zero_ = cell;
  return seconds_ = next.front().second;
}

std::string Clock::remark() const {
  if (decided_.empty()) return "";
  return fmt::format(
      "dates are read with the {} first: the other way {} is weeks away from the row before it",
      readings_.front().order == StrokeDates::day_first ? "day" : "month", in_quotes(decided_));
}

}  // namespace drift
