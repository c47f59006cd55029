// Noise estimated from one next door, and where sizes of noise usually are.
#include <gtest/gtest.h>

#include "analysis/inference/noise/noise.hpp"
#include "analysis/inference/noise/noise_component.hpp"
#include "analysis/inference/projector.hpp"
#include "analysis/inference/signatures.hpp"
#include "core/estimate/batch.hpp"
#include "core/estimate/layout.hpp"
#include "core/estimate/measured_test.hpp"
#include "core/sim/simulate.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::inference::noise_from_test {
namespace {

using namespace drift::test;

/// A test in six positions under a drift random walk [deg/h/sqrt(h)], and a candidate: a slow drift
/// of one gyro.
LinearProblem walked(double drift_random_walk) {
  const Timeline timeline = preset_timeline("six", CommandLaw::free, 1800.0, 60.0);
  const Readout readout;
  TruthSpec truth = base_truth(Coupling::eq5);
  truth.noise.drift_random_walk = drift_random_walk * unit::deg_per_h_per_sqrt_h.to_si;
  const FilterSpec filter = base_filter(Coupling::eq5);
  const Measurements measured = Simulator(truth, readout).run(timeline, 8, 0).measured;
  const MeasuredTest test{timeline, readout, measured};
  LinearProblem p =
      linear_problem(filter, test, fit_batch(filter, test, make_layout(filter).theta), {});
  p.extra = MatX::Zero(p.rows(), 1);
  for (Eigen::Index k = 0; k < p.rows(); ++k) {
    const double t = static_cast<double>(p.tags[k].interval) / 180.0;
    p.extra(k, 0) = p.psi(k, 1) * t * t * (p.tags[k].position % 2 ? 1.0 : -1.0);
  }
  return p;
}

TEST(NoiseFrom, EndsWhereAnEstimateFromNothingEnds) {
  const LinearProblem p = walked(0.01);
  const NoiseEstimate all = estimate_noise(p, {}), again = estimate_noise_from(p, {}, all, {});
  ASSERT_TRUE(all.driven);
  ASSERT_EQ(all.components.size(), again.components.size());
  // Both climbs end where a step gains less than 1e-3.
  EXPECT_NEAR(again.log_evidence(), all.log_evidence(), 0.05);
  const NoiseEstimate beside = estimate_noise(p, {}, {0}),
                      from = estimate_noise_from(p, {}, all, {0});
  EXPECT_NEAR(from.log_likelihood2, beside.log_likelihood2, 0.05);
  EXPECT_NEAR(from.model.drift_random_walk / beside.model.drift_random_walk, 1.0, 0.05);
}

TEST(NoiseFrom, HasNothingLeftWhereTheMeanExplainsAll) {
  LinearProblem p = walked(0.0);
  EXPECT_FALSE(estimate_noise(p, {}).driven);
  p.extra *= 40.0 / std::sqrt(Projector(p, {}).candidates().C(0, 0));
  p.r0 += p.extra.col(0);
  const NoiseEstimate all = estimate_noise(p, {});
  ASSERT_TRUE(all.driven) << "the candidate is slow";
  EXPECT_FALSE(estimate_noise_from(p, {}, all, {0}).driven);
}

TEST(UsualSize, IsThatOfTheGradeThatIsDeclared) {
  NoiseModel declared;
  EXPECT_EQ(usual_size(drift_walk, declared).low, drift_walk.size.low);
  declared.drift_random_walk = 3e-9;
  EXPECT_DOUBLE_EQ(usual_size(drift_walk, declared).high, 6e-9);
  // 0.3 deg/sqrt(h) and bias instabilities of 1.5 to 18 deg/h: floors of Allan deviations that fall
  // by N / sqrt(t) and rise by K sqrt(t).
  NoiseModel coarse;
  coarse.angle_random_walk = 0.3 * unit::deg_per_sqrt_h.to_si;
  const Usual walk = usual_size(drift_walk, coarse), markov = usual_size(markov_drift, coarse);
  EXPECT_NEAR(markov.low / unit::deg_per_h.to_si, 1.5, 1e-9);
  EXPECT_NEAR(markov.high / unit::deg_per_h.to_si, 18.0, 1e-9);
  EXPECT_NEAR(walk.low / unit::deg_per_h_per_sqrt_h.to_si, 1.5 * 1.5 / 0.3, 1e-9);
  EXPECT_NEAR(walk.high / unit::deg_per_h_per_sqrt_h.to_si, 18.0 * 18.0 / 0.3, 1e-9);
}

}  // namespace
}  // namespace drift::inference::noise_from_test
