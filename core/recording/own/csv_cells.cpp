#include "core/recording/own/csv_cells.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <limits>

#include "core/recording/recording_problems.hpp"

namespace drift {
namespace {

std::string_view unquoted(std::string_view cell) {
  cell = trimmed(cell);
  if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"')
    cell = trimmed(cell.substr(1, cell.size() - 2));
  return cell;
}

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

/// "13:05:10.25" from the front of a text.
std::optional<double> take_time_of_day(std::string_view& text) {
  int hour = 0, minute = 0;
  double second = 0.0;
  if (text.empty() || text.front() < '0' || text.front() > '9') return std::nullopt;
  if (!take_number(text, hour) || !take(text, ':') || !take_number(text, minute) ||
      !take(text, ':'))
    return std::nullopt;
  if (!take_number(text, second)) return std::nullopt;
  if (!(hour >= 0 && hour < 24 && minute >= 0 && minute < 60 && second >= 0.0 && second < 61.0))
    return std::nullopt;
  return 3600.0 * hour + 60.0 * minute + second;
}

/// "2026-03-01" or "01.03.2026" from the front of a text, as seconds since 1970.
std::optional<double> take_date(std::string_view& text) {
  int first = 0, month = 0, last = 0;
  if (!take_number(text, first)) return std::nullopt;
  const char mark = text.empty() ? '\0' : text.front();
  if ((mark != '-' && mark != '.' && mark != '/') || !take(text, mark) ||
      !take_number(text, month) || !take(text, mark) || !take_number(text, last))
    return std::nullopt;
  if (mark == '/' && first < 1000) return std::nullopt;  // day or month first? nobody knows
  const bool year_first = first >= 1000;
  using namespace std::chrono;
  const year_month_day date{year(year_first ? first : last), std::chrono::month(month),
                            day(year_first ? last : first)};
  if (!date.ok()) return std::nullopt;
  return 86400.0 * static_cast<double>(sys_days(date).time_since_epoch().count());
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

const std::vector<std::string_view>& CellSplitter::split(std::string_view line) {
  cells_.clear();
  if (delimiter_ == ' ') {
    while (!(line = trimmed(line)).empty()) {
      const bool quoted = line.front() == '"' && line.find('"', 1) != std::string_view::npos;
      const auto end =
          quoted ? line.find('"', 1) + 1 : std::min(line.find_first_of(" \t"), line.size());
      cells_.push_back(unquoted(line.substr(0, end)));
      line.remove_prefix(end);
    }
    return cells_;
  }
  const bool quotes = line.find('"') != std::string_view::npos;
  for (std::size_t begin = 0; begin <= line.size();) {
    auto from = begin;
    if (quotes) {
      const auto start = line.find_first_not_of(" \t", begin);
      if (start != std::string_view::npos && line[start] == '"')
        if (const auto closing = line.find('"', start + 1); closing != std::string_view::npos)
          from = closing;
    }
    const auto end = std::min(line.find(delimiter_, from), line.size());
    cells_.push_back(unquoted(line.substr(begin, end - begin)));
    begin = end + 1;
  }
  return cells_;
}

std::string_view without_checksum(std::string_view line) {
  const std::string_view text = trimmed(line);
  const auto star = text.rfind('*');
  if (star == std::string_view::npos) return line;
  const std::string_view sum = text.substr(star + 1);
  const bool hexadecimal =
      sum.find_first_not_of("0123456789abcdefABCDEF") == std::string_view::npos;
  return hexadecimal && (sum.size() == 2 || sum.size() == 8) ? text.substr(0, star) : line;
}

ParsedCell parse_cell(std::string_view text, DecimalMark decimal) {
  using Kind = ParsedCell::Kind;
  if (text.empty()) return {Kind::number, std::numeric_limits<double>::quiet_NaN(), 0};
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  ParsedCell cell;
  const auto parse = [&](std::string_view digits) {
    const char* const end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), end, cell.value);
    if (error == std::errc::result_out_of_range)
      cell.kind = Kind::out_of_range;
    else
      cell.kind = error == std::errc() && stop == end ? Kind::number : Kind::text;
  };
  const auto comma = text.find(',');
  if (comma == std::string_view::npos) {
    parse(text);
    if (text.find('.') != std::string_view::npos) cell.mark = '.';
  } else {
    char digits[64];
    const bool one = text.find(',', comma + 1) == std::string_view::npos &&
                     text.find('.') == std::string_view::npos && text.size() < sizeof digits;
    if (!one) return cell;
    std::ranges::copy(text, digits);
    digits[comma] = '.';
    parse({digits, text.size()});
    cell.mark = ',';
  }
  const char wanted = decimal == DecimalMark::point ? '.' : ',';
  if (cell.kind == Kind::number && cell.mark != 0 && decimal != DecimalMark::automatic &&
      cell.mark != wanted)
    cell.kind = Kind::wrong_mark;
  return cell;
}

std::optional<double> parse_clock(std::string_view whole) {
  std::string text(trimmed(whole));
  if (const auto comma = text.find(','); comma != std::string::npos) text[comma] = '.';
  std::string_view rest = text;
  if (const auto of_day = take_time_of_day(rest); of_day && rest.empty()) return of_day;
  rest = text;
  const auto date = take_date(rest);
  if (!date || rest.empty()) return std::nullopt;
  if (rest.front() != 'T' && rest.front() != ' ' && rest.front() != '_') return std::nullopt;
  rest.remove_prefix(1);
  const auto of_day = take_time_of_day(rest);
  const auto zone = of_day ? zone_of(trimmed(rest)) : std::nullopt;
  if (!zone) return std::nullopt;
  return *date + *of_day - *zone;
}

std::string lower_case(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

}  // namespace drift
