#include "analysis/inference/noise/noise.hpp"

#include <gtest/gtest.h>

#include "analysis/inference/noise/gross_misfit.hpp"
#include "analysis/inference/noise/robust_weights.hpp"
#include "analysis/search/fitted.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::inference::noise_test {
namespace {

using namespace drift::test;

LinearProblem problem_of(const TruthSpec& truth, std::uint64_t run, double noise_factor) {
  static const Timeline timeline = preset_timeline("six", CommandLaw::free, 1800.0, 60.0);
  const Readout declared;
  Readout real = declared;
  real.accelerometer_noise *= noise_factor;
  const FilterSpec filter = base_filter(Coupling::eq5);
  const Measurements measured = Simulator(truth, real).run(timeline, 6, run).measured;
  const BatchResult fit =
      fit_batch(filter, {timeline, declared, measured}, make_layout(filter).theta);
  return linear_problem(filter, {timeline, declared, measured}, fit, {});
}

const NoiseFinding* find(const NoiseEstimate& e, std::string_view name) {
  for (const NoiseFinding& f : e.findings)
    if (f.component == name) return &f;
  return nullptr;
}

TEST(Noise, WhiteNoiseLargerThanDeclaredIsFoundInItsInstrumentAlone) {
  const NoiseEstimate e = estimate_noise(problem_of(base_truth(Coupling::eq5), 0, 1.5), {});
  const NoiseFinding *acc = find(e, "accelerometer_white"), *gimbal = find(e, "gimbal_white");
  ASSERT_TRUE(acc && gimbal);
  // 540 rows each: sigma of a standard deviation is 1 / sqrt(2 n), three of them.
  EXPECT_NEAR(acc->factor, 1.5, 3.0 * 1.5 / std::sqrt(1080.0));
  EXPECT_NEAR(gimbal->factor, 1.0, 3.0 / std::sqrt(1080.0));
  EXPECT_TRUE(acc->significant);
  EXPECT_FALSE(gimbal->significant);
}

TEST(Noise, NoiseLargerThanDeclaredMakesNoOutliers) {
  const LinearProblem problem = problem_of(base_truth(Coupling::eq5), 0, 1.5);
  VecX residual = Projector(problem, NoiseModel{}).clean_residual();
  EXPECT_EQ(robust_weights(problem, residual), problem.weight);
  for (Eigen::Index k = 0; k < 12; ++k) residual[50 * k] = 12.0;
  EXPECT_GE((robust_weights(problem, residual).array() < 1.0).count(), 12);
}

TEST(Noise, AngleRandomWalkIsFoundWithItsSize) {
  TruthSpec truth = base_truth(Coupling::eq5);
  truth.noise.angle_random_walk = 5e-3 * drift::detail::deg / 60.0;
  double ratio = 0.0;
  constexpr int runs = 3;
  for (int run = 0; run < runs; ++run) {
    const NoiseEstimate e = estimate_noise(problem_of(truth, run, 1.0), {});
    EXPECT_TRUE(e.driven);
    ratio += e.model.angle_random_walk / truth.noise.angle_random_walk / runs;
  }
  // 540 increments of each run, of which the white noise of the instruments leaves about half:
  // 1 / sqrt(2 * 270 * 3) of one sigma; four of them, for what other components take.
  EXPECT_NEAR(ratio, 1.0, 0.10);
}

TEST(Noise, ADeclaredWalkThatIsNotThereIsFoundNotToBe) {
  NoiseModel declared;
  declared.angle_random_walk = 5e-3 * drift::detail::deg / 60.0;
  const NoiseEstimate none =
      estimate_noise(problem_of(base_truth(Coupling::eq5), 0, 1.0), declared);
  const NoiseFinding* found = find(none, "angle_random_walk");
  ASSERT_NE(found, nullptr);
  EXPECT_TRUE(found->significant) << found->factor << " " << found->p_value;
  EXPECT_LT(found->factor, 0.3);
  TruthSpec truth = base_truth(Coupling::eq5);
  truth.noise.angle_random_walk = declared.angle_random_walk;
  const NoiseEstimate there = estimate_noise(problem_of(truth, 0, 1.0), declared);
  EXPECT_FALSE(find(there, "angle_random_walk")->significant);
}

TEST(Noise, MoreOfADeclaredKindThanDeclaredMayBeAnEffect) {
  TruthSpec truth = base_truth(Coupling::eq5);
  truth.noise.angle_random_walk = 5e-3 * drift::detail::deg / 60.0;
  const LinearProblem problem = problem_of(truth, 0, 1.0);
  NoiseModel declared;
  declared.angle_random_walk = truth.noise.angle_random_walk;
  const double found = estimate_noise(problem, declared).model.angle_random_walk;
  declared.angle_random_walk = 1.02 * found;
  EXPECT_FALSE(estimate_noise(problem, declared).driven);
  // What is no rarer than chance may hide an effect as well as what is.
  declared.angle_random_walk = 0.98 * found;
  const NoiseEstimate little = estimate_noise(problem, declared);
  EXPECT_TRUE(little.driven);
  EXPECT_FALSE(find(little, "angle_random_walk")->significant);
  declared.angle_random_walk = 0.25 * found;
  const NoiseEstimate more = estimate_noise(problem, declared);
  EXPECT_TRUE(more.driven);
  EXPECT_GT(find(more, "angle_random_walk")->factor, 2.0);
}

TEST(Noise, AnEffectInTheMeanIsNotTakenForNoise) {
  // A missing column of forty sigmas, smooth in time, looks like noise that drives the platform
  // until it is in the mean.
  LinearProblem problem = problem_of(base_truth(Coupling::eq5), 3, 1.0);
  MatX ramp = MatX::Zero(problem.rows(), 1);
  for (Eigen::Index k = 0; k < problem.rows(); ++k) {
    const double t = static_cast<double>(problem.tags[k].interval) / 180.0;
    ramp(k, 0) = problem.psi(k, 0) * t * t * (problem.tags[k].position % 2 ? 1.0 : -1.0);
  }
  problem.extra = ramp;
  const Projected p = Projector(problem, {}).candidates();
  problem.r0 += 40.0 / std::sqrt(p.C(0, 0)) * ramp;
  // The column's unit is its prior sigma: of the size that is there.
  problem.extra = ramp * (40.0 / std::sqrt(p.C(0, 0)));
  const NoiseEstimate alone = estimate_noise(problem, {}), with = estimate_noise(problem, {}, {0});
  EXPECT_TRUE(alone.driven || alone.model.gimbal_factor > 1.1 || alone.model.acc_factor > 1.1);
  EXPECT_FALSE(with.driven);
  EXPECT_GT(with.log_likelihood2, alone.log_likelihood2 + 20.0);
}

TEST(Noise, DifferencesSeeNoiseThroughAGrossMisfit) {
  LinearProblem problem = problem_of(base_truth(Coupling::eq5), 4, 1.0);
  VecX residual(problem.rows());
  Stream random(4, 4, Purpose::test);
  for (Eigen::Index k = 0; k < residual.size(); ++k)
    residual[k] = 0.5 * static_cast<double>(problem.tags[k].interval) + random.normal();
  const NoiseEstimate e = noise_of_differences(problem, residual);
  EXPECT_NEAR(e.model.acc_factor, 1.0, 3.0 / std::sqrt(2.0 * 0.37 * 0.5 * 540.0));
  EXPECT_TRUE(grossly_wrong(problem, residual, e));
  for (double& r : residual) r = random.normal();
  EXPECT_FALSE(grossly_wrong(problem, residual, noise_of_differences(problem, residual)));
}

}  // namespace
}  // namespace drift::inference::noise_test
