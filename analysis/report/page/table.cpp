#include "analysis/report/page/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/base/check.hpp"
#include "core/base/number_text.hpp"
#include "core/base/words.hpp"

namespace drift::report {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

Column column_of(std::string_view spec) {
  const auto equals = spec.find('=');
  const bool keyed = equals != std::string_view::npos && (equals == 0 || spec[equals - 1] != '>');
  Column column;
  if (keyed) column.key = trimmed(spec.substr(0, equals));
  std::string_view heading = trimmed(keyed ? spec.substr(equals + 1) : spec);
  column.left = heading.starts_with('<');
  column.heading = heading.substr(column.left ? 1 : 0);
  column.shown = column.left || !heading.empty();
  return column;
}

std::string csv_of(const Value& value) {
  if (const auto* number = std::get_if<double>(&value))
    return std::isfinite(*number) ? fmt::format("{:.9g}", *number) : "";
  if (const auto* count = std::get_if<std::int64_t>(&value)) return std::to_string(*count);
  if (const auto* yes = std::get_if<bool>(&value)) return *yes ? "1" : "0";
  if (const auto* text = std::get_if<std::string>(&value)) return csv_field(*text);
  if (const auto* span = std::get_if<std::vector<double>>(&value))
    return fmt::format("{:.9g}", fmt::join(*span, " "));
  return "";
}

}  // namespace

Cell::Cell(double number) : Cell(number, number_text(number)) {}

Cell digits(double value, int count, Tone tone) {
  return {value, number_text(value, count), tone};
}

Cell decimals(double value, int count, Tone tone) {
  return {value, decimal_text(value, count), tone};
}

Cell plus_minus(double value, double sigma) {
  return {value, with_sigma(value, sigma)};
}

Cell p_cell(double p_value) {
  return {p_value, p_text(p_value)};
}

Cell span_cell(double low, double high) {
  return {std::vector{low, high}, std::isfinite(low) || std::isfinite(high)
                                      ? fmt::format("{} to {}", number_text(low), number_text(high))
                                      : "-"};
}

Cell only_value(Value value) {
  return {std::move(value), ""};
}

Cell text_or_nothing(std::string text) {
  if (text.empty()) return {Value(), ""};
  return text;
}

Table::Table(std::string title_, std::string_view columns_, std::string note_)
    : title(std::move(title_)), note(std::move(note_)) {
  add_columns(columns_);
}

void Table::add_columns(std::string_view spec) {
  for (std::size_t from = 0; from <= spec.size();) {
    const std::size_t to = std::min(spec.find('|', from), spec.size());
    columns.push_back(column_of(spec.substr(from, to - from)));
    from = to + 1;
  }
}

Table shown(const Table& table, std::size_t most) {
  Table out;
  out.title = table.title;
  out.note = table.note;
  std::ranges::copy_if(table.columns, std::back_inserter(out.columns), &Column::shown);
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    TableRow row = table.rows[r];
    if (r >= most && !row.always) continue;
    DRIFT_DEMAND(row.cells.size() <= table.columns.size());
    for (std::size_t c = row.cells.size(); !row.heading && c-- > 0;)
      if (!table.columns[c].shown) row.cells.erase(row.cells.begin() + std::ptrdiff_t(c));
    out.rows.push_back(std::move(row));
  }
  if (const std::size_t rest = table.rows.size() - out.rows.size(); rest > 0)
    out.note += fmt::format("{}{} weaker ones are in {}.", out.note.empty() ? "" : " ", rest,
                            table.limit.rest_in);
  return out;
}

std::string csv_of(const Table& table) {
  std::string head, out;
  for (const Column& column : table.columns)
    if (!column.key.empty()) head += (head.empty() ? "" : ",") + csv_field(column.key);
  for (const TableRow& row : table.rows) {
    if (row.heading) continue;
    std::string_view separator = "\n";
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      if (table.columns[c].key.empty()) continue;
      out += std::string(separator) + csv_of(row.cells[c].value);
      separator = ",";
    }
  }
  return head + out + "\n";
}

}  // namespace drift::report
