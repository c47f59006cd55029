// White noise of the gyros as a platform has it, in rows much shorter than those of the estimators.
#include <gtest/gtest.h>

#include <cmath>

#include "core/estimate/batch.hpp"
#include "core/estimate/sequential/ekf.hpp"
#include "core/estimate/sequential/iterated_passes.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::attitude_walk_test {
namespace {

using namespace drift::test;

constexpr int rows_together = 18;  // 10 s in 3 min: 1 / 12 of a sample's noise less 1 / 324 of that

/// Readings of `fine`, so many at a time: the mean of the accelerometers, the last of the gimbals.
Measurements together(const Timeline& fine, const Measurements& all) {
  const auto n = static_cast<Eigen::Index>(fine.intervals.size()) / rows_together;
  Measurements out;
  out.acc = Mat3X::Zero(3, n);
  out.gimbal = Mat3X::Zero(3, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    out.acc.col(k) = all.acc.middleCols(k * rows_together, rows_together).rowwise().mean();
    out.gimbal.col(k) = all.gimbal.col((k + 1) * rows_together - 1);
  }
  return out;
}

/// Sums of chi-square over a few recordings, by estimator.
struct Sums {
  double ekf = 0.0, iterated = 0.0, batch = 0.0, dof = 0.0;
};

Sums fitted(std::string_view plan, CommandLaw law, double walk) {
  const Timeline fine = preset_timeline(plan, law, 3600.0, 180.0 / rows_together),
                 coarse = preset_timeline(plan, law, 3600.0, 180.0);
  EXPECT_EQ(fine.intervals.size(), coarse.intervals.size() * rows_together);
  Readout readout, of_a_row;
  readout.accelerometer_noise = 5e-6;
  readout.gimbal_noise = of_a_row.gimbal_noise = 5.0 * arcsec;
  of_a_row.accelerometer_noise = readout.accelerometer_noise * std::sqrt(rows_together);
  TruthSpec truth = base_truth(Coupling::eq5);
  FilterSpec filter = base_filter(Coupling::eq5);
  truth.active = filter.active = only({"D_F"});
  truth.noise.angle_random_walk = filter.noise.angle_random_walk = walk;
  const Theta start = make_layout(filter).theta;
  Simulator simulator(truth, of_a_row);
  IteratedPasses iterated(filter, coarse, readout, start);
  Sums sums;
  for (std::uint64_t run = 0; run < 8; ++run) {
    const Simulation sim = simulator.run(fine, 59, run);
    EXPECT_TRUE(sim.ode.ok());
    const Measurements measured = together(fine, sim.measured);
    const MeasuredTest test{coarse, readout, measured};
    const EstimateResult ekf = run_ekf(filter, test, start);
    sums.ekf += ekf.statistic;
    sums.dof += static_cast<double>(ekf.measured);
    sums.batch += fit_batch(filter, test, start).estimate.statistic;
    sums.iterated += iterated.run(measured, start).nis();
  }
  return sums;
}

/// The same chi-square as of its own rows, within 4 standard deviations (8 recordings of 6
/// positions: 0.067). With a value held through a sample it was 1.43 at 0.01 deg/sqrt(h).
TEST(AttitudeWalk, OfAPlatformIsThatOfEveryEstimator) {
  for (const CommandLaw law : {CommandLaw::level, CommandLaw::free})
    for (const double walk : {0.003, 0.01}) {
      const Sums sums = fitted("six", law, walk * detail::deg / 60.0);
      const double band = 4.0 * std::sqrt(2.0 / sums.dof);
      EXPECT_NEAR(sums.ekf / sums.dof, 1.0, band) << walk;
      EXPECT_NEAR(sums.iterated / sums.dof, 1.0, band) << walk;
      EXPECT_NEAR(sums.batch / sums.dof, 1.0, band) << walk;
    }
}

}  // namespace
}  // namespace drift::attitude_walk_test
