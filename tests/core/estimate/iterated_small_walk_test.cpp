// A drift that hardly walks: the iterated filter is that of a drift that does not.
#include <gtest/gtest.h>

#include "core/estimate/sequential/iterated_passes.hpp"
#include "core/sim/simulate.hpp"
#include "mc/study/study.hpp"
#include "tests/support/polar_plan.hpp"

namespace drift::iterated_small_walk_test {
namespace {

/// A dead zone of unknown width.
mc::Study study() {
  return mc::read_study_text(
      std::string("schema = 1\n") + test::polar_plan + R"(accelerometer_noise = "10 ug"
[environment]
temperature = "20 degC"
temperature_amplitude = "4 degC"
temperature_period = "2 h"
temperature_ramp = "1 degC/h"
[truth]
coupling = "eq6"
terms = ["fixed_drift", "g_drift", "gyro_misalignment", "temperature_drift_curve",
  "accelerometer_dead_zone", "torquer_temperature"]
[[filter]]
name = "f"
coupling = "eq6"
terms = ["fixed_drift", "g_drift", "gyro_misalignment", "temperature_drift_curve",
  "accelerometer_dead_zone", "torquer_temperature"]
starts = [{}]
[monte_carlo]
runs = 12
seed = 984589
estimator = "iterated"
)",
      "s.toml");
}

TEST(IteratedPasses, AWalkThatIsHardlyOneChangesNothing) {
  // 1e-7 deg/h/sqrt(h) moves the drift by 1e-7 of its prior in this hour, and the platform by 1e-4
  // arcsec, where after a caging it is known to 200. About the filtered attitude run 4 ended 5
  // sigma off, at a chi-square of 310 in place of 116.
  const mc::Study s = study();
  const FilterSpec& still = s.filters.front();
  FilterSpec walks = still;
  walks.noise.drift_random_walk = 1e-7 * unit::deg_per_h.to_si / 60.0;
  const Theta start = make_layout(still).theta;
  for (std::uint64_t run = 0; run < 12; ++run) {
    Timeline timeline = lay_out(s.plan, s.site);
    set_environment(timeline, s.environment, s.monte_carlo.seed, run);
    const Simulation sim = Simulator(s.truth, s.readout).run(timeline, s.monte_carlo.seed, run);
    ASSERT_TRUE(sim.ode.ok());
    IteratedPasses one(still, timeline, s.readout, start), other(walks, timeline, s.readout, start);
    const FilterEstimate &a = one.run(sim.measured, start), &b = other.run(sim.measured, start);
    ASSERT_EQ(a.status(), b.status()) << run;
    EXPECT_NEAR(a.nis(), b.nis(), 1e-3) << run;
    for (std::size_t k = 0; k < one.layout().size(); ++k) {
      const auto i = static_cast<Eigen::Index>(one.layout().params[k]);
      EXPECT_NEAR(a.theta()[i], b.theta()[i], 1e-3 * a.sigma(k)) << run << " " << k;
      EXPECT_NEAR(b.sigma(k) / a.sigma(k), 1.0, 1e-3) << run << " " << k;
    }
  }
}

}  // namespace
}  // namespace drift::iterated_small_walk_test
