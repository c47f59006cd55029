#include <gtest/gtest.h>

#include "analysis/report/identify/sections.hpp"
#include "tests/analysis/report/identify/identification_fixture.hpp"

namespace drift::published_table_test {
namespace {

/// Rows of one source in a table, in order.
std::vector<std::vector<report::Cell>> rows_of(const report::Table& table,
                                               const std::string& source) {
  std::vector<std::vector<report::Cell>> found;
  for (const report::TableRow& row : table.rows)
    if (!row.heading && row.cells.front().text == source) found.push_back(row.cells);
  return found;
}

TEST(PublishedComparison, FlagsThePapersTable1AsTheFiguresOfEngineSection1Say) {
  mc::Study study = test::study();
  study.published = test::table_1();
  const auto tables = report::published_comparison(study, test::identification(study));
  ASSERT_EQ(tables.size(), 2u);
  const std::vector<std::vector<double>> expected{{3.15, 0.68, 1.36}, {9.11, 10.7, 10.65}};
  for (std::size_t f = 0; f < 2; ++f) {
    const auto rows = rows_of(tables[f], "Table 1");
    ASSERT_EQ(rows.size(), 3u);
    for (std::size_t p = 0; p < 3; ++p) {
      const double ratio = std::stod(rows[p][rows[p].size() - 2].text);
      EXPECT_NEAR(ratio, expected[f][p], 0.01 * expected[f][p]);
      EXPECT_EQ(rows[p].back().text == "depends on start", f == 1);
      EXPECT_EQ(rows[p].back().tone == report::Tone::bad, f == 1);
    }
  }
  EXPECT_EQ(rows_of(tables[0], "Table 1")[0].back().text, "doubtful");
  EXPECT_EQ(rows_of(tables[0], "Table 1")[0][1].text, "1.51±0.03");
}

TEST(PublishedComparison, StandsBesideOurRunsTheTruthAndTheIndependentTest) {
  mc::Study study = test::study();
  study.published = test::table_1();
  const auto tables = report::published_comparison(study, test::identification(study));
  for (const char* source :
       {"this run, EKF", "this run, batch", "truth of this run", "component test"})
    EXPECT_EQ(rows_of(tables[1], source).size(), 3u) << source;
  EXPECT_EQ(rows_of(tables[1], "component test")[2][1].text, "112");
  EXPECT_EQ(rows_of(tables[1], "this run, EKF")[0].back().text, "depends on start");
  EXPECT_EQ(rows_of(tables[0], "this run, EKF")[0].back().text, "starts agree");
  EXPECT_LE(text_width(tables[1]), 100u);
}

TEST(PublishedComparison, IndependentTestAloneStandsBesideEveryFilter) {
  mc::Study study = test::study();
  study.published = {test::table_1().back()};
  EXPECT_EQ(report::published_comparison(study, test::identification(study)).size(), 2u);
  study.published.clear();
  EXPECT_TRUE(report::published_comparison(study, test::identification(study)).empty());
}

TEST(PublishedComparison, MissingSigmasGiveNoVerdict) {
  mc::Study study = test::study();
  study.published = {test::published("other paper", "corrected", {{"eta_x", {1.0, 2.0, 3.0}, {}}})};
  const auto tables = report::published_comparison(study, test::identification(study));
  const auto rows = rows_of(tables.at(0), "other paper");
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].back().text, "");
}

}  // namespace
}  // namespace drift::published_table_test
