#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "analysis/report/page/table.hpp"

namespace drift::report {
namespace {

std::string csv_of(const Value& value) {
  if (const auto* number = std::get_if<double>(&value))
    return std::isfinite(*number) ? fmt::format("{:.9g}", *number) : "";
  if (const auto* count = std::get_if<std::int64_t>(&value)) return std::to_string(*count);
  if (const auto* yes = std::get_if<bool>(&value)) return *yes ? "1" : "0";
  if (const auto* text = std::get_if<std::string>(&value)) return report::csv_of(*text);
  if (const auto* span = std::get_if<std::vector<double>>(&value))
    return fmt::format("{:.9g}", fmt::join(*span, " "));
  return "";
}

}  // namespace

std::string csv_of(std::string text) {
  for (char& c : text)
    if (c == ',' || c == '"' || static_cast<unsigned char>(c) < 0x20) c = ' ';
  return text;
}

std::string csv_of(const Table& table) {
  std::string head, out;
  for (const Column& column : table.columns)
    if (!column.key.empty()) head += (head.empty() ? "" : ",") + csv_of(column.key);
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
