#include <fmt/format.h>

#include "analysis/report/rank/report.hpp"
#include "analysis/report/rank/tables.hpp"

namespace drift::report {
namespace {

constexpr std::size_t width = 100;

void add(std::string& out, const Table& table) {
  out += text_of(table, width) + "\n";
}

/// Both equations often fail to see the same: said once then.
void add_null_tables(std::string& out, const planning::RankingGroup& group) {
  Table first = null_table(group.models.front());
  if (group.models.size() == 1) return add(out, first);
  const Table second = null_table(group.models[1]);
  const auto texts = [](const Table& t) {
    std::vector<std::string> all;
    for (const TableRow& row : t.rows)
      for (const Cell& cell : row.cells) all.push_back(cell.text);
    return all;
  };
  if (texts(first) != texts(second)) {
    add(out, first);
    add(out, second);
    return;
  }
  first.title = "Directions this test does not see, by eq. (5) or (6)";
  add(out, first);
}

}  // namespace

std::string to_text(const mc::Study& study, const planning::PlanRanking& rank) {
  std::string out = wrapped(study.title.empty() ? "Observability ranking" : study.title, width);
  out += wrapped(plan_line(study, rank), width, 2) + "\n";
  for (const std::string& line : headlines(study, rank)) out += wrapped("- " + line, width, 2);
  out += "\n";
  for (const planning::RankingGroup& g : rank.groups) {
    const planning::ModelRanking& first = g.models.front();
    add(out, ranking_table(g));
    if (g.models.size() > 1) add(out, coupling_table(g));
    for (const planning::ModelRanking& m : g.models) add(out, elsewhere_table(m));
    add_null_tables(out, g);
    add(out, direction_table(first));
    add(out, position_table(study, first));
    add(out, method_table(first));
    for (const std::string& line : disagreements(first)) out += wrapped("- " + line, width, 2);
    out += "\n";
  }
  if (!rank.better) return out;
  add(out, improvement_table(rank));
  if (rank.better->improvement.steps.empty()) return out;
  add(out, gain_table(rank));
  out += proposed_toml(study, rank);
  return out;
}

}  // namespace drift::report
