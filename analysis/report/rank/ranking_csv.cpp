#include <iterator>

#include "analysis/report/rank/sections.hpp"
#include "core/base/words.hpp"

namespace drift::report {
namespace {

constexpr std::string_view drawn_column = "learning_ratio_at_drawn_truths";  // a range: two columns

/// What stands above a column of the table.
std::string heading_of(const std::string& key) {
  if (key == "key") return "parameter";  // as in estimates.csv
  if (key == "bits") return "bits [bit]";
  return key == drawn_column ? fmt::format("{}_low,{}_high", key, key) : key;
}

/// A cell below it.
std::string field_of(const std::string& key, const Value& value) {
  if (const auto* number = std::get_if<double>(&value)) return csv_number(*number);
  if (const auto* count = std::get_if<std::int64_t>(&value)) return std::to_string(*count);
  if (const auto* text = std::get_if<std::string>(&value)) return csv_field(*text);
  if (const auto* range = std::get_if<std::vector<double>>(&value))
    return csv_number(range->front()) + "," + csv_number(range->back());
  return key == drawn_column ? "," : "";
}

/// The rows of a model, each behind `head`.
void add_rows(const Table& table, const std::string& head, std::string& out) {
  for (const TableRow& row : table.rows) {
    out += head;
    for (std::size_t c = 0; c < table.columns.size(); ++c)
      out += "," + field_of(table.columns[c].key, row.cells[c].value);
    out += "\n";
  }
}

}  // namespace

std::string ranking_csv(const planning::PlanRanking& rank) {
  std::string out = "filter,coupling,of_the_file";
  const Table first = ranking_table(rank.groups.front().models.front(), nullptr);
  for (const Column& column : first.columns) out += "," + heading_of(column.key);
  out += "\n";
  for (const planning::RankingGroup& group : rank.groups)
    for (const planning::RankingGroup::Named& filter : group.each)
      for (const planning::ModelRanking& m : group.models) {
        const Coupling coupling = m.model.spec.coupling;
        add_rows(ranking_table(m, nullptr),
                 fmt::format("{},{},{}", csv_field(filter.name), key_of(coupling),
                             coupling == filter.coupling ? 1 : 0),
                 out);
      }
  return out;
}

}  // namespace drift::report
