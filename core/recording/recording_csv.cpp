#include "core/recording/recording_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "core/recording/line_reader.hpp"

namespace drift {

bool add_fact(RawRecording& raw, std::string_view key, std::string_view value) {
  if (key.size() + value.size() > longest_fact) return false;
  const std::string clean = single_line(key), text = single_line(value);
  for (auto& [known, joined] : raw.facts)
    if (known == clean) {
      if (joined.size() + text.size() + 2 > longest_fact) return false;
      joined += "; " + text;
      return true;
    }
  if (raw.facts.size() >= most_facts) return false;
  raw.facts.emplace_back(clean, text);
  return true;
}

std::string single_line(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
  return std::string(trimmed(out));
}

namespace {

enum class Cell { number, text, decimal_comma, out_of_range };

Cell parse_number(std::string_view text, double& value) {
  if (text.empty()) {
    value = std::numeric_limits<double>::quiet_NaN();
    return Cell::number;
  }
  const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data() + (plus ? 1 : 0), end, value);
  if (error == std::errc::result_out_of_range) return Cell::out_of_range;
  if (error == std::errc() && stop == end) return Cell::number;
  const bool comma = error == std::errc() && *stop == ',' && stop + 1 != end;
  return comma && std::all_of(stop + 1, end, [](char c) { return c >= '0' && c <= '9'; })
             ? Cell::decimal_comma
             : Cell::text;
}

class CsvReader {
 public:
  CsvReader(const std::string& path, Problems& problems) : lines_(path), problems_(problems) {}

  RawRecording read() {
    std::string_view line;
    while (lines_.next(line)) {
      if (lines_.number() == 1) {
        if (line.starts_with("\xFF\xFE") || line.starts_with("\xFE\xFF")) {
          problems_.add("1", "the file is UTF-16", "UTF-8 text", "Save it as UTF-8");
          return {};
        }
        if (line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
      }
      if (!is_text(line)) {
        if (raw_.columns.empty()) return {};
        continue;
      }
      if (trimmed(line).empty()) continue;
      if (line.front() == '#')
        read_comment(line.substr(1));
      else if (!raw_.columns.empty())
        read_row(line);
      else if (!read_header(line))
        return {};
    }
    if (raw_.columns.empty() && problems_.count() == 0)
      problems_.add("1", "there is no header row", "a row such as 'time [s],acc_x [g],...'",
                    "Add the header, or check how the recording was exported");
    for (auto& c : raw_.columns)  // at most an eighth of what is held is idle
      if (c.values.capacity() > c.values.size() + c.values.size() / 8) c.values.shrink_to_fit();
    return std::move(raw_);
  }

 private:
  std::string here() const { return std::to_string(lines_.number()); }
  std::string here(std::string_view column) const {
    return fmt::format("{}:{}", lines_.number(), column);
  }

  bool is_text(std::string_view line) {
    if (lines_.cut()) {
      problems_.add(here(),
                    fmt::format("the line is longer than {} bytes", LineReader::longest_line),
                    "one sample per line", "Check that this is a CSV file with line ends");
      return false;
    }
    const auto bad = std::ranges::find_if(line, [](char c) {
      return (static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7F;
    });
    if (bad == line.end()) return true;
    const auto column = static_cast<std::size_t>(bad - line.begin()) + 1;
    const std::string where = here(std::to_string(column));
    if (*bad == '\r')
      problems_.add(where, "a carriage return inside the line", "lines that end with LF or CRLF",
                    "Convert the line ends");
    else if (*bad == '\0')
      problems_.add(
          where, "a NUL byte", "UTF-8 text",
          "Save the file as UTF-8 (UTF-16 has NUL bytes), or copy it again if it is damaged");
    else
      problems_.add(where, fmt::format("a control character (0x{:02x})", static_cast<int>(*bad)),
                    "UTF-8 text", "Check that this is a CSV file; copy it again if it is damaged");
    return false;
  }

  void read_comment(std::string_view text) {
    const auto equals = text.find('=');
    if (equals == std::string_view::npos || trimmed(text.substr(0, equals)).empty()) return;
    if (!add_fact(raw_, text.substr(0, equals), text.substr(equals + 1)))
      problems_.add(here(), "one fact too many, or one too long",
                    fmt::format("at most {} facts of {} bytes", most_facts, longest_fact),
                    "Shorten the comments");
  }

  bool read_header(std::string_view line) {
    const auto count = [&](char c) { return std::ranges::count(line, c); };
    for (const char c : {';', '\t'})
      if (count(c) > count(delimiter_)) delimiter_ = c;
    std::size_t unnamed = 0;
    for (std::size_t begin = 0; begin <= line.size();) {
      const auto end = std::min(line.find(delimiter_, begin), line.size());
      std::string_view cell = trimmed(line.substr(begin, end - begin));
      begin = end + 1;
      if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"')
        cell = trimmed(cell.substr(1, cell.size() - 2));
      RawColumn column;
      const auto bracket = cell.find('[');
      column.name = trimmed(cell.substr(0, bracket));
      if (double number = 0.0; !cell.empty() && parse_number(cell, number) != Cell::text) {
        problems_.add(here(), "the first row holds the number " + in_quotes(cell),
                      "a header row such as 'time [s],acc_x [g],...'", "Add the header row");
        return false;
      }
      if (bracket != std::string_view::npos) {
        if (cell.back() != ']')
          problems_.add(here(in_quotes(column.name)), "the header cell is " + in_quotes(cell),
                        "'name [unit]'", "Close the bracket at the end of the cell");
        else
          column.unit = trimmed(cell.substr(bracket + 1, cell.size() - bracket - 2));
      }
      if (cell.empty()) ++unnamed;
      raw_.columns.push_back(std::move(column));
    }
    if (unnamed > 0)
      problems_.add(here(),
                    fmt::format("{} of {} header cells are empty", unnamed, raw_.columns.size()),
                    "'name [unit]' in each", "Remove superfluous delimiters or name the columns");
    if (raw_.columns.size() == 1) {
      problems_.add(here(), "the header has one column: " + in_quotes(line),
                    "several, separated by commas, semicolons or tabs", "Check the delimiter");
      raw_.columns.clear();
      return false;
    }
    row_.resize(raw_.columns.size());
    return true;
  }

  void read_row(std::string_view line) {
    const std::size_t n = row_.size();
    const auto cells = static_cast<std::size_t>(std::ranges::count(line, delimiter_)) + 1;
    if (cells != n) {
      const bool comma = delimiter_ == ',' && cells > n;
      problems_.add(
          here(), fmt::format("{} cells", cells), fmt::format("{}, as in the header", n),
          comma ? "Write numbers with a decimal point, not a comma, and remove superfluous cells"
                : "Complete the row, or leave cells empty that were not measured");
      return;
    }
    bool good = true;
    std::size_t begin = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const auto end = std::min(line.find(delimiter_, begin), line.size());
      const auto cell = trimmed(line.substr(begin, end - begin));
      begin = end + 1;
      const Cell kind = parse_number(cell, row_[i]);
      if (kind == Cell::number) continue;
      good = false;
      const std::string where = here(raw_.columns[i].name);
      if (kind == Cell::decimal_comma)
        problems_.add(where, "found " + in_quotes(cell), "a decimal point",
                      "Write the numbers with a point, not a comma");
      else if (kind == Cell::out_of_range)
        problems_.add(where, "found " + in_quotes(cell), "a number between 1e-307 and 1e308",
                      "Correct the number, or choose another unit");
      else
        problems_.add(where, "found " + in_quotes(cell), "a number, nan or an empty cell",
                      "Correct the cell, or leave it empty if it was not measured");
    }
    if (!good) return;
    reserve();
    for (std::size_t i = 0; i < n; ++i) raw_.columns[i].values.push_back(row_[i]);
    raw_.lines.push_back(lines_.number());
  }

  /// Room for the rows to come, judged by those read: doubling would hold twice the recording.
  void reserve() {
    constexpr std::size_t enough = 1000;
    const std::size_t rows = raw_.lines.size();
    if (rows < enough || rows < raw_.lines.capacity()) return;
    const double per_row = static_cast<double>(lines_.consumed()) / static_cast<double>(rows);
    const auto guess =
        static_cast<std::size_t>(1.01 * static_cast<double>(lines_.file_size()) / per_row) + 16;
    const std::size_t room = rows < guess ? std::min(guess, 64 * rows) : rows + rows / 8;
    raw_.lines.reserve(room);
    for (auto& c : raw_.columns) c.values.reserve(room);
  }

  LineReader lines_;
  Problems& problems_;
  RawRecording raw_;
  std::vector<double> row_;
  char delimiter_ = ',';
};

}  // namespace

RawRecording read_csv(const std::string& path, Problems& problems) {
  return CsvReader(path, problems).read();
}

}  // namespace drift
