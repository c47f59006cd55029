#include "mc/export/export_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mc/statistics/point_statistics.hpp"
#include "tests/mc/small_study.hpp"

namespace drift::export_table_test {
namespace {

using namespace drift::test;

const mc::ExportColumn& column(const mc::ExportTable& table, const std::string& name) {
  for (const mc::ExportColumn& c : table.columns)
    if (c.name == name) return c;
  throw std::out_of_range(name);
}

TEST(ExportTable, HoldsTheStatisticsOfTheRuns) {
  const auto points = mc::study_points(read_text(small_study, {{"monte_carlo.estimator", "ekf"}}));
  const auto tasks = mc::study_tasks(points);
  const auto& task = dynamic_cast<const mc::StudyTask&>(*tasks[0].task);
  const auto worker = task.worker();
  mc::PointStatistics expected(points[0].study);  // those of the report
  mc::StatisticsTables gathered(points);
  for (std::uint64_t first = 0; first < 80; first += 16) {
    const mc::Block block = run_block(task, *worker, first, 16);
    expected.add(block);
    gathered.add(block);
  }
  const auto tables = gathered.finish();
  ASSERT_EQ(tables.size(), 3u);
  const mc::ExportTable &statistics = tables[0], &filters = tables[1], &convergence = tables[2];
  const auto& right = expected.filters()[0];
  const auto& wrong = expected.filters()[1];
  const std::size_t n = right.errors().size();
  ASSERT_EQ(statistics.rows(), n + wrong.errors().size());
  EXPECT_EQ(column(statistics, "filter").meanings, (std::vector<std::string>{"right", "wrong"}));
  const mc::ExportColumn& parameter = column(statistics, "parameter");
  EXPECT_EQ(parameter.meanings[static_cast<std::size_t>(parameter.values[1])], "D_F_y");
  EXPECT_EQ(column(statistics, "coverage_2").values[n + 3],
            wrong.errors()[3].coverage()[1].value());
  EXPECT_EQ(column(statistics, "silent_failure_rate").values[n + 3],
            wrong.health()[3].silent.value());
  EXPECT_DOUBLE_EQ(
      column(statistics, "rmse").values[2] * column(statistics, "prior_sigma_si").values[2],
      right.errors()[2].rmse().value);
  EXPECT_EQ(column(statistics, "prior_sigma_si").units, "SI unit of the parameter");
  EXPECT_EQ(column(statistics, "rmse").units, "1");
  const auto& rank = column(statistics, "rank").values;
  const auto best = static_cast<std::size_t>(
      std::find(rank.begin(), rank.begin() + static_cast<std::ptrdiff_t>(n), 1.0) - rank.begin());
  ASSERT_LT(best, n);
  for (const auto& e : right.errors()) EXPECT_GE(e.learning(), right.errors()[best].learning());
  ASSERT_EQ(filters.rows(), 3u) << "two starts and one";
  EXPECT_EQ(column(filters, "nis").values[1], right.starts()[1].nis.mean());
  EXPECT_EQ(column(filters, "silent_failure_rate_high").values[2], wrong.starts()[0].silent.high());
  // After 16, 32, 64 and all 80 runs.
  ASSERT_EQ(convergence.rows(), 4 * statistics.rows());
  EXPECT_EQ(column(convergence, "runs").values.front(), 16.0);
  EXPECT_EQ(column(convergence, "runs").values[2 * statistics.rows()], 64.0);
  EXPECT_EQ(column(convergence, "runs").values.back(), 80.0);
  EXPECT_EQ(column(convergence, "rmse").values.back(), column(statistics, "rmse").values.back());
  EXPECT_LE(column(statistics, "rmse_low").values[0], column(statistics, "rmse").values[0]);
  for (std::size_t k = 0; k < n; ++k) {
    const mc::ErrorStatistics& e = right.errors()[k];
    EXPECT_DOUBLE_EQ(column(statistics, "rmse_low").values[k], e.rmse().low / e.prior_sigma());
    EXPECT_DOUBLE_EQ(column(statistics, "rmse_high").values[k], e.rmse().high / e.prior_sigma());
  }
}

TEST(ExportTable, OneRunHasAnErrorAndNoInterval) {
  const auto points = mc::study_points(read_text(small_study, {{"monte_carlo.estimator", "ekf"}}));
  const auto tasks = mc::study_tasks(points);
  const auto& task = dynamic_cast<const mc::StudyTask&>(*tasks[0].task);
  const mc::Block block = run_block(task, *task.worker(), 0, 1);
  mc::PointStatistics expected(points[0].study);
  mc::StatisticsTables gathered(points);
  expected.add(block);
  gathered.add(block);
  const auto tables = gathered.finish();
  const mc::ErrorStatistics& e = expected.filters()[0].errors()[0];
  EXPECT_DOUBLE_EQ(column(tables[0], "rmse").values[0], e.rmse().value / e.prior_sigma());
  EXPECT_GT(column(tables[0], "rmse").values[0], 0.0);
  EXPECT_TRUE(std::isnan(column(tables[0], "rmse_low").values[0]));
  EXPECT_TRUE(std::isnan(column(tables[0], "rmse_high").values[0]));
}

}  // namespace
}  // namespace drift::export_table_test
