// An effect and noise that explain the same compete by evidence.
#include "analysis/search/settle_noise.hpp"

#include <gtest/gtest.h>

#include "tests/support/model_builders.hpp"
#include "tests/support/two_recordings.hpp"

namespace drift::search::settle_noise_test {
namespace {

using namespace drift::test;

/// A test in six positions with a candidate per axis: a drift that grows with the square of time,
/// signs by position, of 25 projected sigmas at one prior sigma.
Fitted bench() {
  static const Timeline timeline = preset_timeline("six", CommandLaw::free, 1800.0, 60.0);
  const Readout readout;
  Fitted e;
  e.filter = base_filter(Coupling::eq5);
  const Measurements measured =
      Simulator(base_truth(Coupling::eq5), readout).run(timeline, 8, 0).measured;
  const MeasuredTest test{timeline, readout, measured};
  e.problem = inference::linear_problem(e.filter, test,
                                        fit_batch(e.filter, test, make_layout(e.filter).theta), {});
  e.problem.extra = MatX::Zero(e.problem.rows(), 3);
  for (Eigen::Index k = 0; k < e.problem.rows(); ++k) {
    const double t = static_cast<double>(e.problem.tags[k].interval) / 180.0;
    e.problem.extra.row(k) =
        e.problem.psi.row(k) * t * t * (e.problem.tags[k].position % 2 ? 1.0 : -1.0);
  }
  for (int a = 0; a < 3; ++a) {
    const VecX information = inference::Projector(e.problem, {}).candidates().C.diagonal();
    e.problem.extra.col(a) *= 25.0 / std::sqrt(information[a]);
    e.set.candidates.push_back(
        {"term" + std::to_string(a), "", "", {static_cast<std::size_t>(a)}, {{{a}, {}}}});
  }
  return e;
}

std::optional<NoiseSettled> settled(Fitted& e) {
  e.noise = inference::estimate_noise(e.problem, {});
  EXPECT_TRUE(e.noise.driven);  // it would be taken for noise
  return settle_noise(e);
}

TEST(SettleNoise, AnEffectOfOneAxisIsNoNoise) {
  Fitted e = bench();
  e.problem.r0 += e.problem.extra.col(1);
  const auto s = settled(e);
  ASSERT_TRUE(s);
  EXPECT_GT(s->probability, 0.95);
  EXPECT_FALSE(s->noise.driven);
}

TEST(SettleNoise, TwoEffectsTogetherAreNoNoise) {
  Fitted e = bench();
  e.problem.r0 += e.problem.extra.col(0) - e.problem.extra.col(2);
  const auto s = settled(e);
  ASSERT_TRUE(s);
  EXPECT_GT(s->probability, 0.95);
}

TEST(SettleNoise, SettingsThatTheTestCannotTellApartAreNoPrice) {
  const auto probability = [](std::size_t settings) {
    Fitted e = bench();
    e.problem.r0 += 0.3 * e.problem.extra.col(1);
    e.set.candidates[1].variants.resize(settings, e.set.candidates[1].variants.front());
    const auto s = settled(e);
    return s ? s->probability : 0.0;
  };
  const double of_one = probability(1);
  EXPECT_GT(of_one, 0.1);
  EXPECT_NEAR(probability(8), of_one, 1e-9);
}

/// The residuals of noise alone.
void draw(Fitted& e, const inference::NoiseModel& noise) {
  Stream random(9, 0, Purpose::test);
  VecX z(e.problem.rows());
  for (double& v : z) v = random.normal();
  e.problem.r0 = inference::Whitener(e.problem, noise).colour(z);
}

/// A large input makes white noise that has to stand for it large, too: under that it is no more
/// than noise of all three instruments is.
TEST(SettleNoise, ALargeInputInOneEquationIsNoNoise) {
  Fitted e = bench();
  inference::NoiseModel noise;
  noise.lone = {inference::Equation::accelerometer, 0, 20.0 * e.problem.acc_sigma, 1800.0};
  draw(e, noise);
  const auto s = settled(e);
  ASSERT_TRUE(s);
  EXPECT_GT(s->probability, 0.95);
  EXPECT_FALSE(s->noise.driven);
  // Without the input it is 11.6, the root mean square of 1 in two channels and 20 in the third.
  EXPECT_LT(s->noise.model.acc_factor, 2.0);
}

TEST(SettleNoise, ALargeBiasOfOneRecordingIsNoNoise) {
  const Timeline once = preset_timeline("six", CommandLaw::free, 1200.0, 60.0), both = twice(once);
  const Readout readout;
  Fitted e;
  e.filter = base_filter(Coupling::eq5);
  e.filter.active = only({"D_F"}) | params_named("accelerometer");
  TruthSpec truth = base_truth(Coupling::eq5);
  truth.active = e.filter.active;
  const TruthDraw unit = draw_truth(truth, once.chains, 8, 0);
  Simulator simulator(truth, readout);
  Measurements measured = one_after_the_other(simulator.run(once, unit, 8, 0).measured,
                                              simulator.run(once, unit, 8, 1).measured);
  measured.acc.row(1).tail(once.intervals.size()).array() += 200e-6;
  const MeasuredTest test{both, readout, measured};
  e.problem = inference::linear_problem(e.filter, test,
                                        fit_batch(e.filter, test, make_layout(e.filter).theta), {});
  const auto s = settled(e);
  ASSERT_TRUE(s);
  EXPECT_GT(s->probability, 0.95);
  EXPECT_FALSE(s->noise.driven);
  // What is left is as declared: 720 rows, five sigma.
  EXPECT_NEAR(s->noise.model.acc_factor, 1.0, 5.0 / std::sqrt(2.0 * 720.0));
}

TEST(SettleNoise, NoiseOfAllThreeGyrosIsMoreProbableThanEffects) {
  Fitted e = bench();
  inference::NoiseModel noise;
  noise.drift_random_walk = 0.03 * unit::deg_per_h_per_sqrt_h.to_si;
  draw(e, noise);
  const auto s = settled(e);
  EXPECT_TRUE(!s || s->probability < 0.5);
}

}  // namespace
}  // namespace drift::search::settle_noise_test
