// A cost that bends twice as much along a parameter as the rows of the fit say: Gauss and Newton's
// step ends as high on the other side.
#include <gtest/gtest.h>

#include "core/estimate/batch.hpp"
#include "core/sim/simulate.hpp"
#include "mc/study/study.hpp"

namespace drift::descent_overshoot_test {
namespace {

/// The moment of a step of the mass unbalance between slews.
mc::Study study() {
  return mc::read_study_text(R"(schema = 1
[site]
latitude = "45 deg"
[plan]
preset = "slew12"
dwell = "15 min"
sample = "90 s"
mode = "free"
[readout]
accelerometer_noise = "5 ug"
gimbal_noise = "5 arcsec"
[truth]
coupling = "eq5"
terms = ["fixed_drift", "g_drift", "gyro_misalignment", "mass_unbalance_step"]
[truth.parameters]
dD_t0 = { normal = ["1.5 h", "0.2 h"] }
[[filter]]
name = "f"
coupling = "eq5"
terms = ["fixed_drift", "g_drift", "gyro_misalignment", "mass_unbalance_step"]
starts = [{}]
[filter.parameters]
dD_t0 = { normal = ["1.5 h", "0.2 h"] }
[monte_carlo]
runs = 200
seed = 7
estimator = "batch"
)",
                             "s.toml");
}

TEST(DescentOvershoot, ACostThatBendsMoreThanItsRowsSayIsFollowedToItsMinimum) {
  // Forty iterations of steps back and forth ended at 965.65784; parabolas through their ends have
  // the least cost along them at 965.65781, and the bend that was learnt is there sooner.
  constexpr std::uint64_t run = 122;
  const mc::Study s = study();
  const Timeline timeline = lay_out(s.plan, s.site);
  const Simulation sim = Simulator(s.truth, s.readout).run(timeline, s.monte_carlo.seed, run);
  const FilterSpec& filter = s.filters.front();
  const BatchResult fit =
      fit_batch(filter, {timeline, s.readout, sim.measured}, make_layout(filter).theta);
  EXPECT_EQ(fit.estimate.status, EstimateStatus::ok) << fit.estimate.cause;
  EXPECT_LT(fit.estimate.statistic, 965.65783);
  EXPECT_GT(fit.estimate.statistic, 965.65);  // the same minimum
}

TEST(DescentOvershoot, WithTheBendThatWasLearntNoRunGoesBackAndForth) {
  // Together they took 308 iterations by parabolas alone.
  const mc::Study s = study();
  const Timeline timeline = lay_out(s.plan, s.site);
  const FilterSpec& filter = s.filters.front();
  double cost = 0.0;
  for (std::uint64_t run = 0; run < 40; ++run) {
    const Simulation sim = Simulator(s.truth, s.readout).run(timeline, s.monte_carlo.seed, run);
    const BatchResult fit =
        fit_batch(filter, {timeline, s.readout, sim.measured}, make_layout(filter).theta);
    EXPECT_EQ(fit.estimate.status, EstimateStatus::ok) << run;
    EXPECT_LE(fit.estimate.iterations, 20) << run;  // of the forty that are allowed
    cost += fit.estimate.statistic;
  }
  // Where those ended, to the tolerance of forty fits: learning far from the minimum ended in
  // others, 21,000 higher.
  EXPECT_NEAR(cost, 37425.71297, 1e-4);
}

}  // namespace
}  // namespace drift::descent_overshoot_test
