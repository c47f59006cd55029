#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/recording/own/csv_rows.hpp"
#include "core/recording/own/recording_unit.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/recording/sexagesimal.hpp"

namespace drift {
namespace {

using Role = ColumnUse::Role;
using Kind = ParsedCell::Kind;

/// A word such as a logger writes in the place of a number.
bool is_word(std::string_view text) {
  constexpr std::size_t longest = 16;
  return text.size() <= longest && std::ranges::all_of(text, [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' || c == '_' ||
                  c == '/' || c == '.';
         });
}

/// Whether a text that is no number would be one without the marks between its thousands:
/// "1,234.5", "1.234,5", "1'234.5", "1 234,5".
bool has_thousands_marks(std::string_view text) {
  constexpr std::array<std::string_view, 7> marks = {".",      ",",      "'",     " ",
                                                     "\u00A0", "\u202F", "\u2019"};
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  std::size_t found = 0, digits = 0;
  while (!text.empty()) {
    const auto mark =
        std::ranges::find_if(marks, [&](std::string_view m) { return text.starts_with(m); });
    const bool digit = text.front() >= '0' && text.front() <= '9';
    if (mark == marks.end() && !digit) return false;
    ++(digit ? digits : found);
    text.remove_prefix(digit ? 1 : mark->size());
  }
  return found > 0 && digits > 3;
}

}  // namespace

/// Reads a cell into the row, or says what is wrong with it.
std::optional<CsvRows::Complaint> CsvRows::read_cell(std::size_t i, std::string_view cell) {
  const ColumnUse& use = uses_[i];
  row_[i] = std::numeric_limits<double>::quiet_NaN();
  if (use.role == Role::ignored || use.role == Role::date) return std::nullopt;
  if (use.role == Role::position) return read_position(i, cell);
  if (use.role == Role::time && date_column_) return read_time(i, cell);
  RawColumn& column = raw_.columns[i];
  const ParsedCell parsed = parse_cell(cell, format_.decimal);
  if (parsed.kind == Kind::number) {
    row_[i] = parsed.value;
    if (!cell.empty()) ++column.numbers;
    if (parsed.mark == '.' && point_line_ == 0) point_line_ = lines_.number();
    if (parsed.mark == ',' && comma_line_ == 0) comma_line_ = lines_.number();
    if (column.clock && !cell.empty())
      return Complaint{here(use.channel), "found " + in_quotes(cell), "a time as in the rows above",
                       "Write all times alike"};
    return std::nullopt;
  }
  if (use.role == Role::time && parsed.kind == Kind::text) return read_time(i, cell);
  if (use.role == Role::phase && parsed.kind == Kind::text) {
    const std::string word = lower_case(cell);
    if (word == "dwell" || word == "slew") {
      row_[i] = word == "slew" ? 1.0 : 0.0;
      return std::nullopt;
    }
  }
  const bool may_lack = use.role == Role::sensor || use.role == Role::covariate;
  if (may_lack && std::ranges::find(format_.missing, cell) != format_.missing.end())
    return std::nullopt;
  // Beside numbers of such digits the same column would hold two kinds of angles.
  const bool by_marks = format_.angles != AngleDigits::minutes_and_seconds;
  if (by_marks && use.role == Role::sensor && is_angle(use.channel) && parsed.kind == Kind::text)
    if (const auto degrees = angle_in_minutes_and_seconds(cell)) {
      const auto unit = use.unit ? parse_recording_unit(*use.unit) : std::nullopt;
      if (!unit) uses_[i].unit = "deg";
      if (!unit || same_unit(*unit, unit::deg)) {
        row_[i] = *degrees;
        ++column.numbers;
        return std::nullopt;
      }
    }
  if (use.role == Role::covariate && parsed.kind == Kind::text) {
    ++column.texts;
    return std::nullopt;
  }
  const std::string found = "found " + in_quotes(cell);
  if (parsed.kind == Kind::wrong_mark)  // one message for all columns
    return Complaint{here(), found,
                     format_.decimal == DecimalMark::point ? "a decimal point" : "a decimal comma",
                     "Correct recording.decimal of the study file, or the number"};
  if (parsed.kind == Kind::out_of_range)
    return Complaint{here(use.channel), found, "a number between 1e-307 and 1e308",
                     "Correct the number, or choose another unit"};
  std::string fix = "Correct the cell, or leave it empty if it was not measured";
  if (has_thousands_marks(cell))
    fix = "Write numbers without marks between thousands";
  else if (may_lack && is_word(cell))
    fix += fmt::format(
        "; where the file writes that for it, say missing = [\"{}\"] in [recording] of the study "
        "file",
        cell);
  return Complaint{here(use.channel), found, "a number, nan or an empty cell", fix};
}

std::optional<CsvRows::Complaint> CsvRows::read_time(std::size_t i, std::string_view cell) {
  RawColumn& column = raw_.columns[i];
  if (date_column_ && !is_date(date_) && !is_date(date_, StrokeDates::month_first))
    return Complaint{here(layout_.header[*date_column_].whole), "found " + in_quotes(date_),
                     "a date such as 2026-03-01",
                     "Correct it, or remove recording.date from the study file"};
  const bool numbers = column.numbers > 0 && !column.clock;
  const auto seconds =
      clock_.read(date_column_ ? fmt::format("{} {}", date_, cell) : std::string(cell));
  if (!seconds || numbers)
    return Complaint{here("time"), "found " + in_quotes(cell),
                     seconds        ? "a number as in the rows above"
                     : date_column_ ? "a time of day such as 13:05:10.250 beside recording.date"
                                    : "a number, or a time such as 2026-03-01T13:05:10.250",
                     "Write all times alike"};
  constexpr double half_a_day = 43200.0;
  if (date_column_ && !column.values.empty() && *seconds < column.values.back() - half_a_day)
    return Complaint{
        here("time"), fmt::format("{} {} comes before the row above", date_, cell),
        "dates that change at midnight, as the clock does",
        "Correct the dates where they change too early or too late, or leave recording.date out of "
        "the study file: without it the times of day go on past midnight"};
  column.clock = true;
  column.unit = "s";
  ++column.numbers;
  row_[i] = *seconds;
  return std::nullopt;
}

/// Some logs write a date only where it changes.
void CsvRows::take_date(std::string_view cell) {
  if (!cell.empty())
    date_ = cell;
  else if (!date_.empty() && dates_above_++ == 0)
    date_line_ = lines_.number();
}

/// What there is to say of times of a clock.
void CsvRows::note_clock() {
  if (!clock_.zero().empty()) {
    note(fmt::format("time is counted from {}", clock_.zero()));
    add_fact(raw_, "time_zero", clock_.zero());
  }
  if (dates_above_ > 0)
    note(fmt::format("{} row{}, from line {} on, without a date: that of the rows above is taken",
                     dates_above_, dates_above_ == 1 ? "" : "s", date_line_));
  if (clock_.late_dates() > 0)
    raw_.remarks.add(Weight::doubtful,
                     fmt::format("{} date{} of the day before behind midnight: the next day is "
                                 "taken",
                                 clock_.late_dates(), clock_.late_dates() == 1 ? " is" : "s are"));
  if (const std::string how = clock_.remark(); !how.empty())
    raw_.remarks.add(Weight::doubtful, how);
}

std::optional<CsvRows::Complaint> CsvRows::read_position(std::size_t i, std::string_view cell) {
  const auto named = std::ranges::find_if(format_.positions,
                                          [&](const auto& entry) { return entry.first == cell; });
  if (named != format_.positions.end()) {
    row_[i] = named->second == 0 ? std::numeric_limits<double>::quiet_NaN() : named->second;
    return std::nullopt;
  }
  const ParsedCell parsed = parse_cell(cell, format_.decimal);
  if (parsed.kind == Kind::number) {
    row_[i] = parsed.value;
    return std::nullopt;
  }
  std::vector<std::string> known;
  for (const auto& [text, number] : format_.positions) known.push_back(text);
  constexpr std::size_t most = 12;
  known.resize(std::min(most, known.size()));
  return Complaint{
      here("position"), "found " + in_quotes(cell),
      known.empty() ? std::string("the number of a position")
                    : fmt::format("the number of a position, or '{}'", fmt::join(known, "', '")),
      "Say in [recording] of the study file which position each text is: positions = { \"TEXT\" = "
      "NUMBER, ... }; `driftscope look` prints that line to be checked"};
}

}  // namespace drift
