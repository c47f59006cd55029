#include "analysis/report/identify/results_out.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "analysis/report/identify/report.hpp"
#include "core/base/sha256.hpp"
#include "core/recording/hdf5_handle.hpp"
#include "tests/analysis/report/identify/identification_fixture.hpp"
#include "tests/support/program.hpp"

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

/// A text that stands beside an object of a file.
std::string attribute(const std::string& path, const char* object, const char* name) {
  const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  const Hdf5Handle found(H5Aopen_by_name(file.get(), object, name, H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
  if (found.get() < 0) return "there is none";
  const Hdf5Handle type(H5Aget_type(found.get()), H5Tclose);
  std::string text(H5Tget_size(type.get()), '\0');
  EXPECT_GE(H5Aread(found.get(), type.get(), text.data()), 0);
  return text.c_str();
}

TEST(IdentificationArrays, SayFromWhatTheyWereMadeAndWhatChiSquareHolds) {
  mc::Study study = test::study();
  study.text = "schema = 1\n# text\n";
  const identification::Identification id = identification_of(study);
  report::Report said = report::identification_report(study, id);
  said.provenance.recordings = {{"a.csv", "12ab"}, {"b.csv", "34cd"}};
  const test::ScratchFolder scratch;
  report::write_identification(said, id, scratch.file("out"));
  const std::string path = scratch.file("out/identification.nc");
  EXPECT_EQ(attribute(path, "/", "study"), study.text);
  EXPECT_EQ(attribute(path, "/", "study_sha256"), sha256_hex(study.text));
  EXPECT_EQ(attribute(path, "/", "recordings"), "12ab a.csv\n34cd b.csv");
  for (const auto& [key, value] : mc::provenance())
    if (key != "started_utc") {
      EXPECT_EQ(attribute(path, "/", key.c_str()), value) << key;
    }
  EXPECT_EQ(attribute(path, "/", "started_utc").size(), mc::utc_now().size());
  const std::string chi2 = attribute(path, "/chi2", "long_name");
  for (const char* part : {"data", "parameters about their priors", "attitudes at each caging"})
    EXPECT_NE(chi2.find(part), std::string::npos) << chi2;
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
