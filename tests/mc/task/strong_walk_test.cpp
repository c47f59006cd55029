// Drift and attitude that walk, in slews: no path of the parameters alone stays near the attitude.
#include <gtest/gtest.h>

#include "mc/statistics/point_statistics.hpp"
#include "mc/task/study_task.hpp"
#include "tests/mc/small_study.hpp"

namespace drift::strong_walk_test {
namespace {

using namespace drift::test;

/// Good instruments on a plan; what the truth and the right filter are.
mc::Study study_of(std::string_view plan, std::string_view truth, std::string_view filter,
                   std::string_view estimator) {
  return read_text(fmt::format(R"(schema = 1
[site]
latitude = "45.75 deg"
[plan]
{}
[readout]
accelerometer_noise = "5 ug"
gimbal_noise = "5 arcsec"
[truth]
{}
[[filter]]
name = "matched"
{}
[monte_carlo]
runs = 200
seed = 5
estimator = "{}"
)",
                               plan, truth, filter, estimator));
}

/// Twelve slewed positions, all parameters; `noise` in truth and filter.
mc::Study study_with(std::string_view coupling, std::string_view noise,
                     std::string_view estimator = "iterated") {
  const std::string model = fmt::format("coupling = \"{}\"\n{}", coupling, noise);
  return study_of("preset = \"slew12\"\ndwell = \"60 min\"\nsample = \"3 min\"\nmode = \"free\"",
                  model, model, estimator);
}

/// Mean NIS and NEES of a right filter are 1 with the standard deviation sqrt(2 / dof).
void expect_one(const mc::ChiSquareSum& sum, const std::string& what) {
  EXPECT_NEAR(sum.mean(), 1.0, 4.0 * std::sqrt(2.0 / sum.dof)) << what;
}

/// The first start of the right filter in so many runs.
mc::StartStatistics first_start(const mc::Study& study, std::size_t runs, const std::string& what) {
  const mc::StudyTask task(study);
  const auto worker = task.worker();
  mc::PointStatistics statistics(task.study());
  statistics.add(run_block(task, *worker, 0, runs));
  EXPECT_EQ(statistics.failures().lost().hits, 0u) << what;
  return statistics.filters()[0].starts()[0];
}

void expect_consistent(const mc::Study& study, const std::string& what, std::size_t runs = 40) {
  const auto start = first_start(study, runs, what);
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

/// Level positions, samples of ten minutes: one step of the walk is more than all is known by.
mc::Study coarse_study(std::string_view estimator, std::string_view terms_of_truth) {
  const auto model = [](std::string_view terms) {
    return fmt::format(
        "coupling = \"eq6\"\nterms = [{}]\ndrift_random_walk = \"0.01 deg/h/sqrt(h)\"", terms);
  };
  return study_of("preset = \"six\"\ndwell = \"60 min\"\nsample = \"10 min\"\nmode = \"level\"",
                  model(terms_of_truth), model("\"fixed_drift\""), estimator);
}

TEST(MatchedFilter, SaysHowWellTheDriftOfTheLastSampleIsKnown) {
  // With the walk's next step in it sigma was 1.6 times the error: NEES 0.38.
  for (const char* estimator : {"iterated", "ekf"})
    expect_consistent(coarse_study(estimator, "\"fixed_drift\""), estimator, 200);
}

TEST(MatchedFilter, KnowsADriftThatWalksFromZero) {
  // The truth has no constant drift: its walk was in what estimates are compared with, and not in
  // the recording.
  const auto start = first_start(coarse_study("iterated", ""), 200, "from zero");
  expect_one(start.nis, "NIS");
  // Every error is at most that of a drift drawn from the prior.
  EXPECT_LT(start.nees_all.mean(), 1.0 + 4.0 * std::sqrt(2.0 / start.nees_all.dof));
  EXPECT_GT(start.nees_all.mean(), 0.8);
}

}  // namespace
}  // namespace drift::strong_walk_test
