// ranking.csv beside rank.json: the same numbers, to the last bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "analysis/report/rank/sections.hpp"

namespace drift::ranking_csv_test {
namespace {

using Row = std::map<std::string, std::string>;

/// Two filters of one group, and one of its own, on a plan with a truth that leaves eta open.
constexpr const char* text = R"(schema = 1
[site]
latitude = "45.75 deg"
[plan]
preset = "six"
dwell  = "20 min"
sample = "5 min"
mode   = "free"
[truth]
coupling = "eq5"
terms = ["fixed_drift", "gyro_misalignment"]
[[filter]]
name = "corrected, no. #2"
coupling = "eq6"
terms = ["fixed_drift", "gyro_misalignment"]
[[filter]]
name = "biases"
coupling = "eq5"
terms = ["K0"]
[[filter]]
name = "legacy"
coupling = "eq5"
terms = ["fixed_drift", "gyro_misalignment"]
)";

/// Of a line of CSV, whose names may stand in quotes.
std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (const char c : line)
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      fields.emplace_back();
    else
      fields.back() += c;
  return fields;
}

std::vector<Row> rows_of(const std::string& csv) {
  std::istringstream in(csv);
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> heads = fields_of(line);
  std::vector<Row> rows;
  while (std::getline(in, line)) {
    const std::vector<std::string> fields = fields_of(line);
    EXPECT_EQ(fields.size(), heads.size()) << line;
    Row& row = rows.emplace_back();
    for (std::size_t k = 0; k < heads.size(); ++k) row[heads[k]] = fields[k];
  }
  return rows;
}

/// The row says what a member of rank.json says.
void expect_same(const std::string& field, const report::Json& value, const std::string& at) {
  if (value.is_null())
    EXPECT_EQ(field, "") << at;
  else if (value.is_string())
    EXPECT_EQ(field, value.get<std::string>()) << at;
  else
    EXPECT_EQ(std::stod(field), value.get<double>()) << at;
}

TEST(RankingCsv, HasTheNumbersOfRankJson) {
  const mc::Study study = mc::read_study_text(text, "s.toml");
  const planning::PlanRanking rank = planning::rank_plan(study, {.threads = 1});
  const std::vector<Row> rows = rows_of(report::ranking_csv(rank));
  const report::Json document = report::rank_document(study, rank);
  const std::map<std::string, std::pair<std::size_t, std::string>> filters{
      {"corrected, no. #2", {0, "eq6"}}, {"legacy", {0, "eq5"}}, {"biases", {1, "eq5"}}};
  std::size_t compared = 0, drawn = 0;
  for (const auto& filter : filters) {
    const std::string& name = filter.first;
    const auto& own = filter.second;
    for (const report::Json& model : document["filters"][own.first]["models"])
      for (const report::Json& p : model["parameters"]) {
        const std::string key = p["key"].get<std::string>(),
                          coupling = model["coupling"].get<std::string>(),
                          at = name + " " + coupling + " " + key;
        const auto row = std::ranges::find_if(rows, [&](const Row& r) {
          return r.at("filter") == name && r.at("coupling") == coupling && r.at("parameter") == key;
        });
        ASSERT_NE(row, rows.end()) << at;
        EXPECT_EQ(row->at("of_the_file"), coupling == own.second ? "1" : "0") << at;
        for (const auto& [member, value] : p.items()) {
          if (member == "learning_ratio_at_drawn_truths") {
            const bool any = !value.is_null();
            drawn += any;
            expect_same(row->at(member + "_low"), any ? value[0] : value, at + " " + member);
            expect_same(row->at(member + "_high"), any ? value[1] : value, at + " " + member);
          } else {
            const std::string column = member == "key"    ? "parameter"
                                       : member == "bits" ? "bits [bit]"
                                                          : member;
            expect_same(row->at(column), value, at + " " + member);
          }
        }
        ++compared;
      }
  }
  EXPECT_EQ(compared, rows.size()) << "no row is beside them";
  EXPECT_EQ(compared, 2u * 2u * 9u + 2u * 3u);
  EXPECT_GT(drawn, 0u);
}

TEST(RankingCsv, StandsBesideTheReport) {
  const mc::Study study = mc::read_study_text(text, "s.toml");
  const planning::PlanRanking rank = planning::rank_plan(study, {.threads = 1});
  const report::Report said = report::rank_report(study, rank);
  const auto file = std::ranges::find(said.files, "ranking.csv", &TextFile::first);
  ASSERT_NE(file, said.files.end());
  EXPECT_EQ(file->second, report::ranking_csv(rank));
}

}  // namespace
}  // namespace drift::ranking_csv_test
