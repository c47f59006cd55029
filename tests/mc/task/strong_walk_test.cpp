// Drift that walks, in slews: no path of the parameters alone stays near the attitude.
#include <gtest/gtest.h>

#include "mc/statistics/point_statistics.hpp"
#include "mc/task/study_task.hpp"
#include "tests/mc/small_study.hpp"

namespace drift::strong_walk_test {
namespace {

using namespace drift::test;

constexpr std::size_t runs = 40;

/// Good instruments, twelve slewed positions, all parameters; `noise` in truth and filter.
mc::Study study_with(std::string_view coupling, std::string_view noise) {
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
estimator = "iterated"
)",
                               model, model, runs));
}

/// Mean NIS and NEES of a right filter are 1 with the standard deviation sqrt(2 / dof).
void expect_one(const mc::ChiSquareSum& sum, const std::string& what) {
  EXPECT_NEAR(sum.mean(), 1.0, 4.0 * std::sqrt(2.0 / sum.dof)) << what;
}

TEST(MatchedFilter, IsConsistentWhereDriftWalksFarInSlews) {
  // The drift walks 0.035 deg/h: linearised about the path of the parameters alone, NEES was 4
  // to 7.
  for (const char* coupling : {"eq5", "eq6"}) {
    const mc::StudyTask task(study_with(coupling, "drift_random_walk = \"0.01 deg/h/sqrt(h)\""));
    const auto worker = task.worker();
    mc::PointStatistics statistics(task.study(), 0);
    statistics.add(run_block(task, *worker, 0, runs));
    const auto& start = statistics.filters()[0].starts()[0];
    EXPECT_EQ(statistics.failures().lost().hits, 0u) << coupling;
    expect_one(start.nis, fmt::format("{}: NIS", coupling));
    expect_one(start.nees_all, fmt::format("{}: NEES", coupling));
  }
}

}  // namespace
}  // namespace drift::strong_walk_test
