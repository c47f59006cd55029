#include "core/recording/own/guess.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>

#include "core/base/utf8.hpp"
#include "core/recording/line_reader.hpp"
#include "core/recording/own/clock.hpp"
#include "core/recording/own/csv_cells.hpp"
#include "core/recording/own/guess_format.hpp"
#include "core/recording/own/guess_gimbals.hpp"
#include "core/recording/own/guess_names.hpp"
#include "core/recording/own/guess_position.hpp"
#include "core/recording/own/guess_time.hpp"
#include "core/recording/own/guess_values.hpp"
#include "core/recording/own/like_temperature.hpp"
#include "core/recording/own/recording_unit.hpp"
#include "core/recording/own/text_decoding.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/recording/recording_files.hpp"
#include "core/recording/recording_problems.hpp"
#include "core/recording/sexagesimal.hpp"
#include "core/stats/median.hpp"

namespace drift {
namespace {

constexpr std::size_t most_words = 100;

/// Counts what stands in the cells of a column.
void look_at(GuessedColumn& column, std::string_view cell) {
  if (cell.empty()) return;
  column.basic_times = column.basic_times && parse_clock(fmt::format("20000101T{}", cell));
  const ParsedCell parsed = parse_cell(cell, DecimalMark::automatic);
  if (parsed.kind == ParsedCell::Kind::number && std::isfinite(parsed.value)) {
    column.low = column.numbers == 0 ? parsed.value : std::min(column.low, parsed.value);
    column.high = column.numbers == 0 ? parsed.value : std::max(column.high, parsed.value);
    if (is_all_nines(cell)) {
      if (column.nines.size() < most_words) column.nines.emplace(cell);
    } else {
      column.low_beside = std::min(column.low_beside, parsed.value);
      column.high_beside = std::max(column.high_beside, parsed.value);
    }
    if (column.numbers > 0 && parsed.value < column.last && column.back.first == column.back.second)
      column.back = {column.last, parsed.value};
    column.last = parsed.value;
    column.whole = column.whole && parsed.value == std::round(parsed.value);
    ++column.numbers;
  } else if (parsed.kind != ParsedCell::Kind::number) {
    ++column.texts;
    if (column.last_text == cell && !column.text_rows.empty()) ++column.text_rows.back();
    if (column.last_text == cell) return;
    if (column.text_rows.size() <= most_words) column.text_rows.push_back(1);
    column.last_text = cell;
    if (std::ranges::find(column.words, cell) != column.words.end())
      column.again.emplace(cell);
    else if (column.words.size() < most_words)
      column.words.emplace_back(cell);
  }
}

using Cells = std::vector<std::string_view>;

/// Shows every row of a text file that has a cell for each column.
void each_row_of_text(const std::string& path, const GuessedFile& file,
                      const std::function<void(const Cells&)>& look) {
  LineReader lines(path);
  CellSplitter splitter(file.layout.delimiter);
  std::string_view line;
  std::string decoded;
  while (lines.next(line)) {
    if (lines.number() <= std::max(file.layout.header_line, file.layout.last_text)) continue;
    if (trimmed(line).empty() || line.front() == '#') continue;
    if (!valid_utf8(line)) line = decoded = utf8_from_windows_1252(line);
    const auto& cells = splitter.split_row(without_checksum(line), file.columns.size());
    if (cells.size() != file.columns.size()) continue;
    if (std::ranges::none_of(cells, begins_like_number)) continue;  // text, or an empty row
    if (std::ranges::equal(cells, file.columns, {}, {},
                           [](const GuessedColumn& c) { return std::string_view(c.header.whole); }))
      continue;  // the header again
    look(cells);
  }
}

/// Shows the rows of columns of numbers as a text file would have them; up to the end of the
/// shortest column.
void each_row_of_numbers(const std::vector<RawColumn>& columns,
                         const std::function<void(const Cells&)>& look) {
  if (columns.empty()) return;
  const auto length = [](const RawColumn& c) { return c.values.size(); };
  const std::size_t rows = length(*std::ranges::min_element(columns, {}, length));
  std::vector<std::string> texts(columns.size());
  Cells cells(columns.size());
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      texts[i].clear();
      if (const double x = columns[i].values[row]; !std::isnan(x))
        fmt::format_to(std::back_inserter(texts[i]), "{}", x);
      cells[i] = texts[i];
    }
    look(cells);
  }
}

/// What is guessed by the rows.
struct GuessByRows {
  explicit GuessByRows(const GuessedFile& file)
      : by_values(file), by_numbers(file), by_up(file), digits(file) {}

  GuessByValues by_values;
  GuessPosition by_numbers;
  GuessGimbalUnit by_up;
  GuessAngleDigits digits;
};

/// Goes through all rows; the lengths of the specific force in the units of the file come back.
template <class EachRow>
std::vector<double> look_at_rows(EachRow&& each_row, GuessedFile& file, GuessByRows& rows) {
  std::vector<double> lengths;
  std::array<std::size_t, 3> acc{};
  bool triple = true;
  for (int a = 0; a < 3; ++a) {
    const auto it =
        std::ranges::find(file.columns, fmt::format("acc_{}", "xyz"[a]), &GuessedColumn::channel);
    triple = triple && it != file.columns.end();
    acc[a] = static_cast<std::size_t>(it - file.columns.begin());
  }
  each_row([&](const Cells& cells) {
    ++file.rows;
    for (std::size_t i = 0; i < cells.size(); ++i) look_at(file.columns[i], cells[i]);
    rows.by_values.look_at_row(cells);
    rows.by_numbers.look_at_row(cells);
    rows.by_up.look_at_row(cells);
    rows.digits.look_at_row(cells);
    if (!triple) return;
    const auto f = [&](int a) { return parse_cell(cells[acc[a]], DecimalMark::automatic).value; };
    if (const double length = std::hypot(f(0), f(1), f(2)); std::isfinite(length))
      lengths.push_back(length);
  });
  return lengths;
}

/// The unit of accelerations that makes their usual length that of gravity; "?" if none does.
std::string unit_of_gravity(std::vector<double> lengths) {
  if (lengths.empty()) return "?";
  const double usual = stats::upper_median(std::move(lengths));
  constexpr std::pair<double, std::string_view> sizes[] = {
      {1.0, "g"}, {9.80665, "m/s^2"}, {1e3, "mg"}, {1e6, "ug"}};
  for (const auto& [size, unit] : sizes)
    if (std::abs(usual / size - 1.0) < 0.05) return std::string(unit);
  return "?";
}

/// The one column without a channel for which something holds, named; none or several: nothing is.
template <class Holds>
void name_the_only(GuessedFile& file, std::string_view channel, Holds&& holds) {
  if (std::ranges::find(file.columns, channel, &GuessedColumn::channel) != file.columns.end())
    return;
  const auto free = [&](const GuessedColumn& c) { return c.channel.empty() && holds(c.header); };
  const auto first = std::ranges::find_if(file.columns, free);
  if (first != file.columns.end() &&
      std::find_if(first + 1, file.columns.end(), free) == file.columns.end())
    first->channel = channel;
}

/// Time and temperature tell themselves by their units, whatever they are called.
void name_by_unit(GuessedFile& file) {
  name_the_only(file, "time", [](const HeaderCell& cell) {
    const auto unit = cell.unit ? parse_recording_unit(*cell.unit) : std::nullopt;
    return unit && unit->dim == unit::s.dim;
  });
  name_the_only(file, "temperature", looks_like_temperature);
}

/// Names the channels; of two columns that may be one channel, the first is, but a symbol of one
/// letter ("T") after all words.
void name_channels(GuessedFile& file) {
  std::vector<std::size_t> order;
  for (const bool symbols : {false, true})
    for (std::size_t i = 0; i < file.columns.size(); ++i)
      if ((file.columns[i].header.name.size() == 1) == symbols) order.push_back(i);
  for (const std::size_t i : order) {
    GuessedColumn& c = file.columns[i];
    std::string channel = guessed_channel(c.header.name);
    const auto all = canonical_channels(RecordingKind::platform);
    if (std::ranges::find(all, c.header.name) != all.end()) channel = c.header.name;
    if (may_measure(c.header, channel) &&
        std::ranges::find(file.columns, channel, &GuessedColumn::channel) == file.columns.end())
      c.channel = channel;
  }
  name_third_gimbal(file);
  name_by_unit(file);
  guess_counter(file);
  const auto has = [&](std::string_view start) {
    return std::ranges::any_of(
        file.columns, [&](const GuessedColumn& c) { return c.channel.starts_with(start); });
  };
  if (!has("gyro_") || has("gimbal_") || has("position")) return;
  file.kind = RecordingKind::strapdown;
  for (GuessedColumn& c : file.columns)  // a navigator's own, and of no turntable
    if (c.channel == "case_heading") c.channel.clear();
}

/// The one column of a few texts, each in one stretch of rows, may name the positions; dates and
/// times of a clock do not, nor remarks.
void name_position_by_values(GuessedFile& file) {
  if (file.kind != RecordingKind::platform ||
      std::ranges::find(file.columns, "position", &GuessedColumn::channel) != file.columns.end())
    return;
  const auto few_texts = [&](const GuessedColumn& c) {
    return c.channel.empty() && c.texts == file.rows && c.again.empty() && c.words.size() > 1 &&
           c.words.size() < most_words && !holds_dates(c) && !holds_times(c) &&
           !angle_in_minutes_and_seconds(c.words.front());
  };
  if (std::ranges::count_if(file.columns, few_texts) != 1) return;
  GuessedColumn& column = *std::ranges::find_if(file.columns, few_texts);
  column.channel = "position";
  column.by_values = true;
}

}  // namespace

/// Where the first row holds numbers there is no header: the columns are numbered.
void name_columns_without_header(GuessedFile& file) {
  std::size_t numbers = 0;
  for (const HeaderCell& cell : file.layout.header)
    if (!cell.whole.empty() &&
        parse_cell(cell.whole, DecimalMark::automatic).kind == ParsedCell::Kind::number)
      ++numbers;
  if (numbers < 2 || 2 * numbers < file.layout.header.size()) return;
  // The fields of NovAtel's short log of raw increments; the size of a count is that of its IMU.
  constexpr std::array<std::string_view, 13> raw_imu{
      "log", "header_week", "header_seconds", "imu", "week", "seconds", "status", "az", "minus_ay",
      "ax",  "gz",          "minus_gy",       "gx"};
  const bool novatel = file.layout.header.front().whole == "%RAWIMUSXA" &&
                       file.layout.header.size() == raw_imu.size();
  for (std::size_t i = 0; i < file.layout.header.size(); ++i) {
    file.format.header.push_back(novatel ? std::string(raw_imu[i])
                                         : fmt::format("column_{}", i + 1));
    file.layout.header[i] = header_cell(file.format.header.back());
  }
  if (file.layout.delimiter == ',') file.format.delimiter = Delimiter::comma;
  file.layout.header_line = file.layout.unit_line = file.layout.last_text = 0;
}

GuessedFile guess_file(const std::string& path) {
  GuessedFile file;
  file.text = !is_binary_file(path);
  std::vector<RawColumn> numbers;
  if (file.text) {
    file.layout = find_layout(path, {}, RecordingKind::platform);
    name_columns_without_header(file);
  } else {
    Problems problems(path);
    numbers = read_binary(path, problems).columns;
    problems.throw_if_any();
    for (const RawColumn& c : numbers)
      file.layout.header.push_back({c.name, c.name, c.unit, false});
  }
  for (const HeaderCell& cell : file.layout.header) {
    GuessedColumn column;
    column.header = cell;
    file.columns.push_back(std::move(column));
  }
  name_channels(file);
  GuessByRows rows(file);
  const auto each_row = [&](const std::function<void(const Cells&)>& look) {
    if (file.text)
      each_row_of_text(path, file, look);
    else
      each_row_of_numbers(numbers, look);
  };
  std::string gravity = unit_of_gravity(look_at_rows(each_row, file, rows));
  if (const std::string unit = rows.by_values.name_channels(file); !unit.empty()) gravity = unit;
  name_time_by_values(file);
  name_position_by_values(file);
  rows.by_numbers.name_channel(file);
  leave_out_nines(file);
  const auto take_units_of = [&](std::string_view channels) {
    for (GuessedColumn& c : file.columns)
      if (c.unit.empty() && c.channel.starts_with(channels)) c.unit = guessed_unit_of(c, gravity);
  };
  take_units_of("acc_");
  if (const std::string unit = rows.by_up.unit(file); !unit.empty())
    for (GuessedColumn& c : file.columns)
      if (c.channel.starts_with("gimbal_")) c.unit = unit;
  take_units_of("");
  count_clock_of_numbers(file);
  fill_format(file);
  file.format.angles = rows.digits.found(file);
  return file;
}

}  // namespace drift
