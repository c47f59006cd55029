// What a plan promises of a filter with process noise, beside what its runs find.
#include <gtest/gtest.h>

#include <map>

#include "analysis/report/study/sections.hpp"
#include "tests/mc/small_study.hpp"

namespace drift::process_noise_promised_test {
namespace {

using namespace drift::test;

/// A filter that knows the walk of the truth's drift, and one that knows a tenth of it.
constexpr const char* study = R"toml(schema = 1
[site]
latitude = "45.75 deg"
[plan]
preset = "six"
dwell  = "30 min"
sample = "2 min"
mode   = "level"
[truth]
coupling = "eq5"
terms = ["fixed_drift", "gyro_misalignment"]
drift_random_walk = "0.01 deg/h/sqrt(h)"
[[filter]]
name = "right"
coupling = "eq5"
terms = ["fixed_drift", "gyro_misalignment"]
drift_random_walk = "0.01 deg/h/sqrt(h)"
[[filter]]
name = "sure"
coupling = "eq5"
terms = ["fixed_drift", "gyro_misalignment"]
drift_random_walk = "0.001 deg/h/sqrt(h)"
[monte_carlo]
runs = 100
seed = 3
estimator = "ekf"
)toml";

TEST(PromiseUnderProcessNoise, IsWhatTheRunsFindWhereTheFilterKnowsOfIt) {
  report::StudyResults results;
  results.study = read_text(study);
  results.points = mc::study_points(results.study);
  const mc::StudyTask task(results.points[0].study);
  const auto worker = task.worker();
  results.statistics.emplace_back(task.study());
  results.statistics.back().add(run_block(task, *worker, 0, 100));
  std::map<std::string, std::map<std::string, int>> verdicts;  // by filter
  for (const report::Block& block : report::information_section(results, 1).blocks)
    if (const auto* table = std::get_if<report::Table>(&block.content))
      for (const report::TableRow& row : table->rows)
        ++verdicts[table->title.find("filter right") != std::string::npos ? "right" : "sure"]
                  [row.cells.back().text];
  // Of nine intervals of 95 % one or two may miss what they are of by more than a tenth.
  EXPECT_GE(verdicts["right"]["agree"], 7);
  EXPECT_EQ(verdicts["right"]["process noise"], 0);
  EXPECT_EQ(verdicts["sure"]["agree"], 0);
}

}  // namespace
}  // namespace drift::process_noise_promised_test
