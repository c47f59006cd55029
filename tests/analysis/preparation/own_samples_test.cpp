// Positions that have a sample of their own in the plan.
#include <gtest/gtest.h>

#include "analysis/identification/identify.hpp"
#include "analysis/preparation/prepare.hpp"
#include "analysis/preparation/recorded_test.hpp"
#include "tests/support/six_positions.hpp"

namespace drift::preparation::own_samples_test {
namespace {

/// Six caged positions of 20 minutes: of 4, 12, 4, 20, 20 and 20 samples.
mc::Study study() {
  mc::Study s = test::six_study(1200.0, 60.0);
  s.plan.positions[0].sample = s.plan.positions[2].sample = 300.0;
  s.plan.positions[1].sample = 100.0;
  s.has_truth = true;
  return s;
}

/// The noise of every accelerometer is that of one sample, and all are measured.
void expect_one_sample_each(const Prepared& p) {
  const RecordedTest made = recorded_test(p.study, p.recordings);
  ASSERT_EQ(made.timeline.intervals.size(), 80u);
  EXPECT_TRUE(made.measured.acc.array().isFinite().all());
  for (const Interval& i : made.timeline.intervals) {
    const Position& planned = p.study.plan.positions[static_cast<std::size_t>(i.position)];
    EXPECT_NEAR(i.length(), planned.sample, 1e-9) << i.t1;
    EXPECT_NEAR(i.accelerometer_noise(5e-6), 5e-6, 1e-15) << i.t1;
  }
}

TEST(OwnSamples, RowsOfThePlanAreOneSampleEachAndNoneIsMissing) {
  const Prepared p = prepare(study(), {test::simulated(study())});
  expect_one_sample_each(p);
  EXPECT_FALSE(test::says(p, "missing"));
  EXPECT_FALSE(test::says(p, "longer than is usual"));
}

TEST(OwnSamples, FineRowsAreJoinedToTheSampleOfTheirPosition) {
  mc::Study fine = study();
  for (Position& p : fine.plan.positions) p.sample = 20.0;
  expect_one_sample_each(prepare(study(), {test::simulated(fine)}));
}

TEST(OwnSamples, AMissingRowIsMissingByTheSampleOfItsPosition) {
  Recording r = test::simulated(study());
  for (Channel& c : r.channels) c.values.erase(c.values.begin() + 1);
  r.lines.erase(r.lines.begin() + 1);
  const Prepared p = prepare(study(), {r});
  EXPECT_TRUE(test::says(p, "1 row is missing within positions, in 1 gap"));
}

TEST(OwnSamples, TheFileGivesTheAnswerOfTheSimulation) {
  const mc::Study s = study();
  const auto simulated = identification::identify_simulated(s, 0, 1);
  const auto recorded = identification::identify_recordings(s, simulated.recordings, 1);
  const EstimateResult &a = simulated.runs.front().batch.estimate,
                       &b = recorded.runs.front().batch.estimate;
  EXPECT_EQ(a.measured, b.measured);
  ASSERT_EQ(a.parameters.size(), b.parameters.size());
  // The same numbers but for rounding: 1e-16 of 1 g beside 5 ug is 2e-11 sigma, of 480 scalars.
  EXPECT_NEAR(a.statistic, b.statistic, 1e-6 * a.statistic);
  for (std::size_t k = 0; k < a.parameters.size(); ++k) {
    EXPECT_NEAR(a.parameters[k].value, b.parameters[k].value, 1e-6 * a.parameters[k].sigma) << k;
    EXPECT_NEAR(a.parameters[k].sigma, b.parameters[k].sigma, 1e-6 * a.parameters[k].sigma) << k;
  }
}

}  // namespace
}  // namespace drift::preparation::own_samples_test
