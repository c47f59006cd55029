#include "analysis/report/page/json.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/base/check.hpp"

namespace drift::report {
namespace {

Json json_of(const Value& value) {
  return std::visit(
      [](const auto& v) {
        if constexpr (std::is_same_v<decltype(v), const std::monostate&>)
          return Json(nullptr);
        else
          return Json(v);
      },
      value);
}

/// Indices of the columns with these keys, in this order; without keys of all that have one.
std::vector<std::size_t> columns_of(const Table& table, std::string_view keys) {
  std::vector<std::size_t> columns;
  if (keys.empty())
    for (std::size_t c = 0; c < table.columns.size(); ++c)
      if (!table.columns[c].key.empty()) columns.push_back(c);
  std::istringstream words{std::string(keys)};
  for (std::string key; words >> key;) {
    const auto at = std::ranges::find(table.columns, key, &Column::key);
    DRIFT_EXPECTS(at != table.columns.end());
    columns.push_back(static_cast<std::size_t>(at - table.columns.begin()));
  }
  return columns;
}

}  // namespace

Json rows_json(const Table& table, std::string_view keys) {
  const auto columns = columns_of(table, keys);
  Json rows = Json::array();
  for (const TableRow& row : table.rows) {
    if (row.heading) continue;
    Json one = Json::object();
    for (const std::size_t c : columns) one[table.columns[c].key] = json_of(row.cells[c].value);
    rows.push_back(std::move(one));
  }
  return rows;
}

Json directions_json(const std::vector<NamedDirection>& directions) {
  Json all = Json::array();
  for (const NamedDirection& d : directions) {
    Json parts = Json::object();
    for (const auto& part : d.parts)
      parts[std::string(TermLibrary::specs[part.param].key.view())] = part.coefficient;
    all.push_back({{"combination", d.combination},
                   {"coefficients", parts},
                   {"signal_sigma", d.signal},
                   {"unrounded_signal_sigma", d.unrounded},
                   {"reason", text_or_null(d.reason)}});
  }
  return all;
}

Json text_or_null(const std::string& text) {
  return text.empty() ? Json(nullptr) : Json(text);
}

void add_tables(Json& document, const std::vector<Section>& sections) {
  for (const Section& section : sections)
    for (const Block& block : section.blocks)
      if (const auto* table = std::get_if<Table>(&block.content);
          table && !table->id.empty() && !document.contains(table->id))
        document[table->id] = rows_json(*table);
}

std::string dumped(const Json& document) {
  return document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace drift::report
