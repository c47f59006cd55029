#include "analysis/report/identify/results_out.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "tests/analysis/report/identify/identification_fixture.hpp"

namespace drift::results_out_test {
namespace {

std::vector<std::vector<std::string>> rows_of(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    std::istringstream cells(line + ",");
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

/// The fixture with covariances, residuals and samples: 0.1 prior sigmas each, the first two
/// parameters of start 1 of the first filter correlated by one half.
identification::Identification identification_of(const mc::Study& study) {
  identification::Identification id = test::identification(study);
  for (identification::FilterRun& run : id.runs) {
    const auto n = static_cast<Eigen::Index>(run.ekf.parameters.size());
    run.ekf.covariance = run.batch.estimate.covariance = 0.01 * MatX::Identity(n, n);
    run.batch.acc_residual = Mat3X::Constant(3, 300, 0.25);
    run.batch.gimbal_residual = Mat3X::Constant(3, 300, std::nan(""));
  }
  id.runs[0].ekf.covariance(0, 1) = id.runs[0].ekf.covariance(1, 0) = 0.005;
  for (std::size_t i = 0; i < 300; ++i)
    id.samples.push_back(
        {60.0 * static_cast<double>(i + 1), i < 150 ? 1 : 2, i == 150, 5e-6, 1e-5});
  return id;
}

TEST(ResultTables, ANameWithACommaIsQuotedNotChanged) {
  const mc::Study study = test::study();
  identification::Identification id = identification_of(study);
  id.summaries[0].name = "corrected, \"1962\"";
  for (const auto& [file, text] : report::result_tables(id))
    EXPECT_NE(text.find("\n\"corrected, \"\"1962\"\"\",eq5,1,"), std::string::npos) << file;
}

TEST(ResultTables, HaveARowForEveryFilterStartEstimatorAndParameterInItsUnit) {
  const mc::Study study = test::study();
  const auto tables = report::result_tables(identification_of(study));
  ASSERT_EQ(tables.size(), 3u);
  ASSERT_EQ(tables[0].first, "estimates.csv");
  const auto rows = rows_of(tables[0].second);
  const std::size_t n = make_layout(study.filters[0]).size();
  ASSERT_EQ(rows.size(), 1 + 2 * 3 * 2 * n);
  for (const auto& row : rows) ASSERT_EQ(row.size(), rows[0].size());
  EXPECT_EQ(rows[1][0], "corrected");
  EXPECT_EQ(rows[1][2], "1") << "starts are counted from 1";
  EXPECT_EQ(rows.back()[0], "legacy");
  EXPECT_EQ(rows.back()[2], "3");
  EXPECT_EQ(rows.back()[3], "batch");
  for (const auto& row : rows)
    if (row[4] == "eta_x" && row[3] == "batch") {
      EXPECT_EQ(row[5], "arcsec");
      EXPECT_NEAR(std::stod(row[6]), 100.0, 1e-9);
      EXPECT_NEAR(std::stod(row[7]), 20.0, 1e-9);
      EXPECT_NEAR(std::stod(row[11]), 100.0, 1e-9) << "the truth";
    }
}

TEST(ResultTables, CovarianceIsThatOfTheValuesInTheirUnits) {
  const mc::Study study = test::study();
  const auto rows = rows_of(report::result_tables(identification_of(study))[1].second);
  const std::size_t n = make_layout(study.filters[0]).size();
  ASSERT_EQ(rows.size(), 1 + 2 * 3 * 2 * n * (n + 1) / 2) << "each pair once";
  EXPECT_EQ(rows[2][4], "D_F_x");
  EXPECT_EQ(rows[2][5], "D_F_y");
  EXPECT_NEAR(std::stod(rows[2][8]), 0.005, 1e-12) << "prior sigma 1 deg/h, both";
  EXPECT_NEAR(std::stod(rows[2][9]), 0.5, 1e-12);
  std::size_t found = 0;
  for (const auto& row : rows)
    if (row[4] == "eta_x" && row[5] == "eta_x") {
      ++found;
      EXPECT_NEAR(std::stod(row[8]), 400.0, 1e-9) << "20 arcsec squared";
      EXPECT_NEAR(std::stod(row[9]), 1.0, 1e-12);
    }
  EXPECT_EQ(found, 12u);
}

TEST(ResultTables, ResidualsHaveARowForEverySample) {
  const mc::Study study = test::study();
  const auto rows = rows_of(report::result_tables(identification_of(study))[2].second);
  ASSERT_EQ(rows.size(), 1u + 2 * 3 * 300);
  EXPECT_EQ(rows[151][3], "150");
  EXPECT_EQ(rows[151][4], "9060");
  EXPECT_EQ(rows[151][5], "2");
  EXPECT_EQ(rows[151][6], "1") << "a slew";
  EXPECT_EQ(rows[1][7], "0.25");
  EXPECT_EQ(rows[1][10], "") << "not measured";
  EXPECT_EQ(rows[1].end()[-2], "6");
  EXPECT_EQ(rows[1].back(), "1") << "the only recording";
}

TEST(ResultTables, AnEstimateWithoutCovarianceLeavesItEmpty) {
  const mc::Study study = test::study();
  const auto rows = rows_of(report::result_tables(test::identification(study))[1].second);
  ASSERT_GT(rows.size(), 1u);
  EXPECT_EQ(rows[1].size(), 10u);
  EXPECT_EQ(rows[1][8], "");
}

}  // namespace
}  // namespace drift::results_out_test
