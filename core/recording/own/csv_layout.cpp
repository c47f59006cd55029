#include "core/recording/own/csv_layout.hpp"

#include <algorithm>
#include <optional>

#include "core/base/utf8.hpp"
#include "core/recording/line_reader.hpp"
#include "core/recording/own/clock.hpp"
#include "core/recording/own/csv_cells.hpp"
#include "core/recording/own/guess_names.hpp"
#include "core/recording/own/recording_unit.hpp"
#include "core/recording/own/text_decoding.hpp"
#include "core/recording/recording_problems.hpp"

namespace drift {
namespace {

constexpr std::size_t most_lines = 200;  // a preamble is not longer

struct Line {
  std::size_t number = 0;
  std::string text;
};

/// The first lines that are neither empty nor comments. The last is what is no text, if anything.
std::vector<Line> first_lines(const std::string& path, std::size_t skip) {
  LineReader reader(path);
  std::vector<Line> lines;
  std::string_view text;
  while (lines.size() < most_lines && reader.next(text)) {
    if (reader.number() <= skip) continue;
    const bool damaged = reader.cut() || std::ranges::any_of(text, [](char c) {
                           return static_cast<unsigned char>(c) < 0x20 && c != '\t';
                         });
    if (!damaged && (trimmed(text).empty() || text.front() == '#')) continue;
    lines.push_back({reader.number(), valid_utf8(text) || damaged ? std::string(text)
                                                                  : utf8_from_windows_1252(text)});
    if (damaged) break;
  }
  return lines;
}

char mark_of(Delimiter delimiter) {
  switch (delimiter) {
    case Delimiter::comma:
      return ',';
    case Delimiter::semicolon:
      return ';';
    case Delimiter::tab:
      return '\t';
    default:
      return ' ';
  }
}

/// What separates the cells of a header: what occurs most often, blanks if nothing else does.
char delimiter_of(std::string_view line, const RecordingFormat& format) {
  if (format.delimiter != Delimiter::automatic) return mark_of(format.delimiter);
  char best = ' ';
  std::ptrdiff_t most = 0;
  for (const char c : {',', ';', '\t', '|'})
    if (const auto count = std::ranges::count(line, c); count > most) {
      best = c;
      most = count;
    }
  return best;
}

/// What separates the cells of a row of numbers, where a comma may stand within a number.
char row_delimiter(std::string_view line, const RecordingFormat& format) {
  if (format.delimiter != Delimiter::automatic) return mark_of(format.delimiter);
  for (const char c : {'|', ';', '\t', ','})
    if (line.find(c) != std::string_view::npos) return c;
  return ' ';
}

std::vector<HeaderCell> header_cells(std::string_view line, char delimiter) {
  CellSplitter splitter(delimiter);
  std::vector<HeaderCell> cells;
  for (const auto text : splitter.split(line)) {
    // With blanks between cells, "time [s]" is one all the same.
    const bool unit = delimiter == ' ' && !cells.empty() && text.starts_with('[');
    cells.push_back(
        header_cell(unit ? cells.back().whole + " " + std::string(text) : std::string(text)));
    if (unit) cells.erase(cells.end() - 2);
  }
  return cells;
}

bool is_row_of_numbers(std::string_view line, char delimiter) {
  line = without_checksum(line);
  CellSplitter splitter(delimiter);
  std::size_t numbers = 0, filled = 0;
  for (const auto cell : splitter.split(line)) {
    if (cell.empty()) continue;
    ++filled;
    if (parse_cell(cell, DecimalMark::automatic).kind == ParsedCell::Kind::number ||
        parse_clock(cell) || parse_clock(cell, StrokeDates::month_first))
      ++numbers;
  }
  return numbers >= 2 && 2 * numbers >= filled;
}

/// That of a header above its first row: what divides the row, where it divides the header into as
/// many cells ("t, s;x, g" above "1,5;2,5").
char delimiter_above(const std::vector<Line>& lines, std::size_t header,
                     const RecordingFormat& format) {
  const std::string& text = lines[header].text;
  const auto row = std::find_if(
      lines.begin() + static_cast<std::ptrdiff_t>(header) + 1, lines.end(), [&](const Line& line) {
        return is_row_of_numbers(line.text, row_delimiter(line.text, format));
      });
  const char best = delimiter_of(text, format);
  if (row == lines.end()) return best;
  const char of_row = row_delimiter(row->text, format);
  const auto marks = std::ranges::count(text, of_row);
  return of_row != ' ' && marks > 0 && marks == std::ranges::count(row->text, of_row) ? of_row
                                                                                      : best;
}

std::string_view without_brackets(std::string_view cell) {
  if (cell.size() >= 2 &&
      ((cell.front() == '[' && cell.back() == ']') || (cell.front() == '(' && cell.back() == ')')))
    return trimmed(cell.substr(1, cell.size() - 2));
  return cell;
}

/// Whether a line below the header holds units: no number, and units in most of its cells.
bool is_row_of_units(const std::vector<std::string_view>& cells) {
  std::size_t units = 0, filled = 0;
  for (const auto cell : cells) {
    if (cell.empty() || cell == "-") continue;
    if (cell != "1" && parse_cell(cell, DecimalMark::automatic).kind == ParsedCell::Kind::number)
      return false;
    ++filled;
    if (cell != "1" && parse_recording_unit(without_brackets(cell))) ++units;
  }
  return units > 0 && 2 * units >= filled;
}

constexpr std::size_t most_header_lines = 4;

/// How many lines below the header are units or words, and not yet rows; 0 if no row of numbers
/// follows them.
std::size_t text_lines_below(const std::vector<Line>& lines, std::size_t header, char delimiter) {
  CellSplitter splitter(delimiter);
  const auto is_text = [&](const Line& line) {
    const auto& cells = splitter.split(line.text);
    return is_row_of_units(cells) || std::ranges::all_of(cells, [](std::string_view cell) {
             return cell.empty() ||
                    (parse_cell(cell, DecimalMark::automatic).kind == ParsedCell::Kind::text &&
                     !parse_clock(cell) && !is_date(cell));
           });
  };
  std::size_t n = 0;
  while (n + 1 < most_header_lines && header + n + 1 < lines.size() &&
         is_text(lines[header + n + 1]))
    ++n;
  const bool rows_follow =
      header + n + 1 < lines.size() && is_row_of_numbers(lines[header + n + 1].text, delimiter);
  return rows_follow ? n : 0;
}

/// Index of the line above the first row of numbers that has most names of channels, two and more;
/// empty if none has.
std::optional<std::size_t> line_of_names(const std::vector<Line>& lines, std::size_t first_row,
                                         char delimiter, std::size_t width) {
  std::optional<std::size_t> best;
  std::ptrdiff_t most = 1;
  for (std::size_t i = first_row; i > 0 && i + most_header_lines > first_row; --i) {
    const auto cells = header_cells(lines[i - 1].text, delimiter);
    if (cells.size() != width) break;
    const auto names = std::ranges::count_if(
        cells, [](const HeaderCell& c) { return !guessed_channel(c.name).empty(); });
    if (names > most) {
      most = names;
      best = i - 1;
    }
  }
  return best;
}

/// Index of the header among the lines.
std::size_t find_header(const std::vector<Line>& lines, const RecordingFormat& format,
                        RecordingKind kind) {
  if (format.skip_rows > 0) return 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto cells = header_cells(lines[i].text, delimiter_of(lines[i].text, format));
    if (std::ranges::count_if(cells,
                              [&](const HeaderCell& c) { return is_known(c, format, kind); }) >= 2)
      return i;
  }
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const char delimiter = row_delimiter(lines[i].text, format);
    if (!is_row_of_numbers(lines[i].text, delimiter)) continue;
    CellSplitter splitter(delimiter);
    const std::size_t width = splitter.split(lines[i].text).size();
    if (const auto named = line_of_names(lines, i, delimiter, width)) return *named;
    std::size_t header = i == 0 ? 0 : i - 1;
    if (header > 0 && is_row_of_units(splitter.split(lines[header].text)) &&
        splitter.split(lines[header - 1].text).size() == width)
      --header;
    return header;
  }
  return 0;
}

}  // namespace

CsvLayout find_layout(const std::string& path, const RecordingFormat& format, RecordingKind kind) {
  CsvLayout layout;
  const auto lines = first_lines(path, format.skip_rows);
  if (lines.empty()) return layout;
  if (!format.header.empty()) {
    layout.header_line = format.skip_rows;
    layout.delimiter = row_delimiter(lines.front().text, format);
    for (const std::string& name : format.header) layout.header.push_back(header_cell(name));
    return layout;
  }
  const std::size_t at = find_header(lines, format, kind);
  layout.header_line = lines[at].number;
  layout.above = at;
  layout.delimiter = delimiter_above(lines, at, format);
  layout.header = header_cells(lines[at].text, layout.delimiter);
  const std::size_t below = text_lines_below(lines, at, layout.delimiter);
  if (below > 0) layout.last_text = lines[at + below].number;
  CellSplitter splitter(layout.delimiter);
  for (std::size_t k = at + 1; k < lines.size() && k <= at + std::max<std::size_t>(below, 1); ++k) {
    const auto& units = splitter.split(lines[k].text);
    if (units.size() > layout.header.size() || !is_row_of_units(units)) continue;
    layout.unit_line = lines[k].number;
    layout.last_text = std::max(layout.last_text, layout.unit_line);
    for (std::size_t i = 0; i < units.size(); ++i)
      if (const auto unit = without_brackets(units[i]); !unit.empty() && unit != "-")
        if (!layout.header[i].unit) layout.header[i].unit = unit;
    break;
  }
  return layout;
}

}  // namespace drift
