#include "core/recording/own/csv_cells.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
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

const std::vector<std::string_view>& CellSplitter::split_row(std::string_view line,
                                                             std::size_t width) {
  split(line);
  if (cells_.size() == width + 1 && cells_.back().empty()) cells_.pop_back();
  return cells_;
}

bool begins_like_number(std::string_view cell) {
  return !cell.empty() && std::string_view("0123456789+-.,").find(cell.front()) != cell.npos;
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
  constexpr std::string_view minus = "\u2212";  // what word processors write
  if (text.find(minus) != std::string_view::npos && text.size() < 64) {
    std::string plain(text);
    for (std::size_t at; (at = plain.find(minus)) != std::string::npos;)
      plain.replace(at, minus.size(), "-");
    return parse_cell(plain, decimal);
  }
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

double cell_number(std::string_view cell) {
  const ParsedCell parsed = parse_cell(cell, DecimalMark::automatic);
  return parsed.kind == ParsedCell::Kind::number ? parsed.value : std::nan("");
}

bool is_all_nines(std::string_view cell) {
  const std::size_t first = cell.starts_with('-') || cell.starts_with('+') ? 1 : 0;
  const std::size_t mark = std::min(cell.find_first_of(".,"), cell.size());
  const auto only = [](std::string_view digits) {
    return digits.find_first_not_of('9') == std::string_view::npos;
  };
  std::string_view behind = cell.substr(std::min(mark + 1, cell.size()));
  behind = behind.substr(0, behind.find_last_not_of('0') + 1);
  return mark >= first + 3 && only(cell.substr(first, mark - first)) && only(behind);
}

std::string lower_case(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

}  // namespace drift
