#include "core/recording/own/csv_rows.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/base/utf8.hpp"
#include "core/recording/own/text_decoding.hpp"

namespace drift {
namespace {

using Role = ColumnUse::Role;

constexpr std::string_view header_example = "a header row such as 'time [s],acc_x [g],...'";

}  // namespace

CsvRows::CsvRows(const std::string& path, CsvLayout layout, const RecordingFormat& format,
                 RecordingKind kind, Problems& problems)
    : lines_(path),
      layout_(std::move(layout)),
      format_(format),
      problems_(problems),
      splitter_(layout_.delimiter) {
  if (layout_.above > 0 && format_.skip_rows == 0)
    note(fmt::format("the header is line {}: {} lines above it are passed over",
                     layout_.header_line, layout_.above));
  if (layout_.unit_line > 0) note(fmt::format("line {} is read as the units", layout_.unit_line));
  if (layout_.last_text > layout_.unit_line || layout_.unit_line > layout_.header_line + 1)
    note(fmt::format("rows begin below line {}: other text below the header is passed over",
                     layout_.last_text));
  const std::size_t before = problems.count();
  if (is_header_sound()) uses_ = uses_of_columns(layout_.header, format, kind, problems, raw_);
  raw_.settled = problems.count() == before;
  for (const HeaderCell& cell : layout_.header) {
    RawColumn column;
    column.name = cell.whole;
    raw_.columns.push_back(std::move(column));
  }
  row_.resize(raw_.columns.size());
  if (const auto date = std::ranges::find(uses_, Role::date, &ColumnUse::role);
      date != uses_.end()) {
    date_column_ = static_cast<std::size_t>(date - uses_.begin());
    clock_ = Clock(true);
  }
}

std::string CsvRows::here(std::string_view column) const {
  return column.empty() ? std::to_string(lines_.number())
                        : fmt::format("{}:{}", lines_.number(), column);
}

/// Whether a line is text, which may be Windows-1252; says so if not.
bool CsvRows::is_text(std::string_view line) {
  if (lines_.cut()) {
    problems_.add(here(), fmt::format("the line is longer than {} bytes", LineReader::longest_line),
                  "one sample per line", "Check that this is a CSV file with line ends");
    return false;
  }
  const auto bad = std::ranges::find_if(line, [](char c) {
    return (static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7F;
  });
  if (bad == line.end()) return true;
  const std::string where = here(std::to_string(bad - line.begin() + 1));
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

/// What can be wrong with the header as text. The line itself is examined when it is read.
bool CsvRows::is_header_sound() {
  const std::string at = std::to_string(layout_.header_line);
  if (layout_.header.size() == 1 && format_.rate && !layout_.header.front().name.empty())
    return true;
  for (const HeaderCell& cell : layout_.header) {
    const auto control = [](char c) { return static_cast<unsigned char>(c) < 0x20 && c != '\t'; };
    if (std::ranges::any_of(cell.whole, control)) return false;  // said when the line is read
    if (cell.open)
      problems_.add(fmt::format("{}:{}", at, in_quotes(cell.name)),
                    "the header cell is " + in_quotes(cell.whole), "'name [unit]'",
                    "Close the bracket at the end of the cell");
    if (!cell.whole.empty() &&
        parse_cell(cell.whole, DecimalMark::automatic).kind == ParsedCell::Kind::number) {
      problems_.add(at, "the first row holds the number " + in_quotes(cell.whole), header_example,
                    "Add the header row, or name the columns in [recording] of the study file: "
                    "header = [\"...\"]");
      return false;
    }
  }
  return layout_.header.size() > 1;
}

RawRecording CsvRows::read(const ReadProgress& progress) {
  constexpr std::size_t lines_told = 20000;  // a tenth of a second
  std::string_view line;
  if (layout_.header_line == 0 && uses_.empty()) return {};
  while (lines_.next(line)) {
    if (progress && lines_.number() % lines_told == 0)
      progress(part_of(lines_.consumed(), lines_.file_size()));
    const bool header = lines_.number() == layout_.header_line;
    if (lines_.number() < layout_.header_line && !line.starts_with('#')) continue;
    if (!is_text(line)) {
      if (header) return {};
      continue;
    }
    if (!valid_utf8(line)) {
      if (windows_line_ == 0) windows_line_ = lines_.number();
      line = decoded_ = utf8_from_windows_1252(line);
    }
    if (header) {
      if (layout_.header.size() == 1 && uses_.empty() && problems_.count() == 0)
        problems_.add(here(), "the header has one column: " + in_quotes(line),
                      "several, separated by commas, semicolons or tabs",
                      "Check the delimiter (recording.delimiter in the study file)");
      if (uses_.empty()) return {};
      continue;
    }
    if (trimmed(line).empty()) continue;
    if (line.front() != '#' && lines_.number() <= layout_.last_text) continue;
    if (line.front() == '#')
      read_comment(line.substr(1));
    else if (lines_.number() > layout_.header_line)
      read_row(line);
  }
  finish();
  return with_channels(std::move(raw_), uses_, format_, problems_);
}

void CsvRows::read_comment(std::string_view text) {
  const auto equals = text.find('=');
  if (equals == std::string_view::npos || trimmed(text.substr(0, equals)).empty()) return;
  if (!add_fact(raw_, text.substr(0, equals), text.substr(equals + 1)))
    problems_.add(here(), "one fact too many, or one too long",
                  fmt::format("at most {} facts of {} bytes", most_facts, longest_fact),
                  "Shorten the comments");
}

/// Programs that write again after a pause write their header again, and its row of units.
bool CsvRows::repeats_header(const std::vector<std::string_view>& cells) const {
  const auto is = [](std::string_view cell, const HeaderCell& header) {
    return cell == header.whole;
  };
  if (std::ranges::equal(cells, layout_.header, is)) return true;
  return layout_.unit_line > 0 && repeated_headers_ > 0 && repeated_line_ + 1 == lines_.number() &&
         cells.size() == layout_.header.size() && std::ranges::none_of(cells, begins_like_number);
}

void CsvRows::read_row(std::string_view line) {
  const std::size_t n = row_.size();
  const auto& cells = splitter_.split_row(without_checksum(line), n);
  if (repeats_header(cells)) {
    if (repeated_headers_ > 0 && repeated_line_ + 1 == lines_.number()) return;  // its units
    ++repeated_headers_;
    repeated_line_ = lines_.number();
    return;
  }
  const auto filled = std::ranges::count_if(cells, [](auto cell) { return !cell.empty(); });
  if (filled == 0 && !format_.rate) return;  // delimiters alone: a spreadsheet's empty row
  const bool text =
      (filled < std::ssize(row_) && std::ranges::none_of(cells, begins_like_number)) ||
      names_no_time(cells);
  if (text && (footer_lines_ > 0 || pending_.empty())) {
    if (footer_lines_++ == 0) footer_line_ = lines_.number();
  } else {
    footer_lines_ = 0;
    report_pending();
  }
  if (cells.size() != n) {
    const bool comma = layout_.delimiter == ',' && cells.size() > n;
    Complaint complaint{
        here(), fmt::format("{} cells", cells.size()),
        fmt::format("{}, as in the header{}", n,
                    format_.header.empty() ? "" : " of the study file"),
        comma
            ? "Write numbers with a decimal point and without marks between thousands, and remove "
              "superfluous cells"
            : "Complete the row, or leave cells empty that were not measured"};
    if (cells.size() > n)
      problems_.add(complaint.where, complaint.wrong, complaint.expected, complaint.fix);
    else
      pending_.push_back(std::move(complaint));
    return;
  }
  if (!lines_.ended() && may_be_cut(cells.back())) {
    last_row_cut_ = true;
    return;
  }
  if (date_column_) take_date(cells[*date_column_]);
  for (std::size_t i = 0; i < n; ++i)
    if (auto complaint = read_cell(i, cells[i])) pending_.push_back(std::move(*complaint));
  if (!pending_.empty()) {
    if (lines_.ended() && !text) report_pending();
    return;
  }
  note_end(cells.back());
  reserve();
  for (std::size_t i = 0; i < n; ++i) raw_.columns[i].values.push_back(row_[i]);
  raw_.lines.push_back(lines_.number());
}

/// Whether a word stands where the time should, "Mean" before the means of all columns. More lines
/// than a summary has are rows whose time cannot be read.
bool CsvRows::names_no_time(const std::vector<std::string_view>& cells) const {
  constexpr std::size_t most = 20;
  const auto time = std::ranges::find(uses_, Role::time, &ColumnUse::role);
  const auto at = static_cast<std::size_t>(time - uses_.begin());
  return !raw_.lines.empty() && footer_lines_ < most && at < std::min(cells.size(), uses_.size()) &&
         !cells[at].empty() && !begins_like_number(cells[at]) &&
         parse_cell(cells[at], DecimalMark::automatic).kind == ParsedCell::Kind::text;
}

/// Whether the last cell of a line without line end may lack its end: it is kept only if it looks
/// like all those above it.
bool CsvRows::may_be_cut(std::string_view cell) const {
  if (uses_.back().role == Role::ignored || lower_case(cell) == "nan") return false;
  if (rows_have_ends_ && cell == last_end_) return false;
  const auto point = cell.find_first_of(".,");
  return !decimals_ || *decimals_ == 0 || point == std::string_view::npos ||
         cell.size() - point - 1 != *decimals_ || cell.find_first_of("eE") != cell.npos;
}

void CsvRows::note_end(std::string_view cell) {
  const auto point = cell.find_first_of(".,");
  const bool plain = cell.find_first_of("eE") == std::string_view::npos;
  const std::size_t decimals =
      plain && point != std::string_view::npos ? cell.size() - point - 1 : 0;
  if (!rows_have_ends_)
    decimals_ = decimals;
  else if (decimals_ && *decimals_ != decimals)
    decimals_.reset();
  rows_have_ends_ = true;
  last_end_ = cell;
}

void CsvRows::note(std::string remark) {
  raw_.remarks.add(Weight::note, std::move(remark));
}

void CsvRows::report_pending() {
  for (const Complaint& c : pending_) problems_.add(c.where, c.wrong, c.expected, c.fix);
  pending_.clear();
}

void CsvRows::finish() {
  if (!pending_.empty() && raw_.lines.empty()) report_pending();
  if (footer_lines_ > 0)
    note(footer_lines_ == 1
             ? fmt::format("line {}, the last, is text: it is left out", footer_line_)
             : fmt::format("lines {} to {}, the last, are text: they are left out", footer_line_,
                           lines_.number()));
  else if (!pending_.empty() || last_row_cut_)
    note(fmt::format("line {}, the last, is cut off: it is left out", lines_.number()));
  if (repeated_headers_ > 0)
    note(fmt::format("the header stands again in {}: passed over",
                     repeated_headers_ == 1 ? fmt::format("line {}", repeated_line_)
                                            : fmt::format("{} lines, the last of them {}",
                                                          repeated_headers_, repeated_line_)));
  if (windows_line_ > 0)
    note(fmt::format("line {}: bytes that are not UTF-8 are read as Windows-1252", windows_line_));
  note_clock();
  if (point_line_ > 0 && comma_line_ > 0 && format_.decimal == DecimalMark::automatic)
    problems_.add(std::to_string(std::max(point_line_, comma_line_)),
                  fmt::format("decimal {} here, decimal {} in line {}",
                              comma_line_ > point_line_ ? "commas" : "points",
                              comma_line_ > point_line_ ? "points" : "commas",
                              std::min(point_line_, comma_line_)),
                  "one of the two", "Write all numbers alike");
  for (std::size_t i = 0; i < raw_.columns.size(); ++i)
    if (layout_.header[i].whole.empty() && raw_.columns[i].numbers + raw_.columns[i].texts > 0)
      problems_.add(std::to_string(layout_.header_line),
                    fmt::format("cell {} of the header is empty, but its column is not", i + 1),
                    "'name [unit]' in each", "Remove superfluous delimiters or name the columns");
  for (auto& c : raw_.columns)  // at most an eighth of what is held is idle
    if (c.values.capacity() > c.values.size() + c.values.size() / 8) c.values.shrink_to_fit();
}

/// Room for the rows to come, judged by those read: doubling would hold twice the recording.
void CsvRows::reserve() {
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

}  // namespace drift
