// Drift and attitude that walk, in slews: no path of the parameters alone stays near the attitude.
#include <gtest/gtest.h>

#include "mc/statistics/point_statistics.hpp"
#include "mc/task/study_task.hpp"
#include "tests/mc/small_study.hpp"

namespace drift::strong_walk_test {
namespace {

using namespace drift::test;

constexpr std::size_t runs = 40;

/// Good instruments, twelve slewed positions, all parameters; `noise` in truth and filter.
mc::Study study_with(std::string_view coupling, std::string_view noise,
                     std::string_view estimator = "iterated") {
  const std::string model = fmt::format("coupling = \"{}\"\n{}", coupling, noise);
  return read_text(fmt::format(R"(schema = 1
[site]
latitude = "45.75 deg"
[plan]
preset = "slew12"
dwell = "60 min"
sample = "3 min"
mode = "free"
[readout]
accelerometer_noise = "5 ug"
gimbal_noise = "5 arcsec"
[truth]
{}
[[filter]]
name = "matched"
{}
[monte_carlo]
runs = {}
seed = 5
estimator = "{}"
)",
                               model, model, runs, estimator));
}

/// Mean NIS and NEES of a right filter are 1 with the standard deviation sqrt(2 / dof).
void expect_one(const mc::ChiSquareSum& sum, const std::string& what) {
  EXPECT_NEAR(sum.mean(), 1.0, 4.0 * std::sqrt(2.0 / sum.dof)) << what;
}

/// NIS and NEES of the first start of the right filter.
void expect_consistent(const mc::Study& study, const std::string& what) {
  const mc::StudyTask task(study);
  const auto worker = task.worker();
  mc::PointStatistics statistics(task.study(), 0);
  statistics.add(run_block(task, *worker, 0, runs));
  const auto& start = statistics.filters()[0].starts()[0];
  EXPECT_EQ(statistics.failures().lost().hits, 0u) << what;
  expect_one(start.nis, what + ": NIS");
  expect_one(start.nees_all, what + ": NEES");
}

TEST(MatchedFilter, IsConsistentWhereDriftWalksFarInSlews) {
  // The drift walks 0.035 deg/h: linearised about the path of the parameters alone, NEES was 4
  // to 7.
  for (const char* coupling : {"eq5", "eq6"})
    expect_consistent(study_with(coupling, "drift_random_walk = \"0.01 deg/h/sqrt(h)\""), coupling);
}

TEST(MatchedFilter, IsConsistentWhereTheAttitudeWalks) {
  // Eight arcsec a sample against 5 arcsec and 5 ug: with half of it at the middle of the sample,
  // where the simulator has a quarter, NIS was 0.78.
  const std::string_view noise = "angle_random_walk = \"0.01 deg/sqrt(h)\"";
  for (const char* estimator : {"iterated", "ekf", "batch"})
    expect_consistent(study_with("eq5", noise, estimator), estimator);
}

}  // namespace
}  // namespace drift::strong_walk_test
