#include "analysis/inference/noise/lone_input.hpp"

#include <gtest/gtest.h>

#include "analysis/inference/evidence.hpp"
#include "analysis/inference/projector.hpp"
#include "analysis/search/fitted.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::inference::lone_input_test {
namespace {

using namespace drift::test;

/// A test in six positions with a candidate per axis: a drift that grows with the square of time,
/// signs by position, in units of `size` projected sigmas.
struct Bench {
  LinearProblem problem;
  CandidateSet set;

  explicit Bench(double size) {
    static const Timeline timeline = preset_timeline("six", CommandLaw::free, 1800.0, 60.0);
    const Readout readout;
    const FilterSpec filter = base_filter(Coupling::eq5);
    const Measurements measured =
        Simulator(base_truth(Coupling::eq5), readout).run(timeline, 8, 0).measured;
    const BatchResult fit =
        fit_batch(filter, {timeline, readout, measured}, make_layout(filter).theta);
    problem = linear_problem(filter, {timeline, readout, measured}, fit, {});
    problem.extra = MatX::Zero(problem.rows(), 3);
    for (Eigen::Index k = 0; k < problem.rows(); ++k) {
      const double t = static_cast<double>(problem.tags[k].interval) / 180.0;
      problem.extra.row(k) =
          problem.psi.row(k) * t * t * (problem.tags[k].position % 2 ? 1.0 : -1.0);
    }
    for (int a = 0; a < 3; ++a) {
      const VecX information = Projector(problem, {}).candidates().C.diagonal();
      problem.extra.col(a) *= size / std::sqrt(information[a]);
      set.candidates.push_back(
          {"term" + std::to_string(a), "", "", {static_cast<std::size_t>(a)}, {{{a}, {}}}});
    }
  }
};

TEST(LoneInput, IsFoundInItsEquation) {
  const Bench b(8.0);
  EXPECT_GT(strongest_lone_input(b.problem, {}).p_value, 0.01);  // nothing there
  for (const LoneInput& input :
       {LoneInput{Equation::accelerometer, 2, 2.0 * b.problem.acc_sigma, 300.0},
        LoneInput{Equation::gimbal, 0, b.problem.gimbal_sigma, 300.0},
        LoneInput{Equation::rate, 1, 0.1 * deg_per_h, 3600.0}}) {
    LinearProblem problem = b.problem;
    NoiseModel noise;
    noise.lone = input;
    Stream random(10, 0, Purpose::test);
    VecX z(problem.rows());
    for (double& v : z) v = random.normal();
    problem.r0 = Whitener(problem, noise).colour(z);
    const LoneEffect found = strongest_lone_input(problem, {});
    EXPECT_LT(found.p_value, 1e-4);
    EXPECT_EQ(found.input.equation, input.equation);
    EXPECT_EQ(found.input.axis, input.axis) << found.equation;
  }
}

TEST(LoneInput, AnotherConstantInEachRecordingIsFoundAsThat) {
  const Bench b(8.0);
  LinearProblem several = b.problem;
  IntervalDrive& fourth = several.drives[several.drives.size() / 2];  // of six positions
  ASSERT_TRUE(fourth.cage);
  fourth.begins = true;
  for (const LoneInput& input :
       {LoneInput{Equation::gimbal, 0, 4.0 * several.gimbal_sigma, LoneInput::constant},
        LoneInput{Equation::rate, 1, 0.2 * deg_per_h, LoneInput::constant}}) {
    // The constants are drawn, too, and in some draws they are alike: half of the draws must do.
    int found_as_that = 0;
    for (std::uint32_t draw = 0; draw < 8; ++draw) {
      LinearProblem problem = several;
      NoiseModel noise;
      noise.lone = input;
      Stream random(10, draw, Purpose::test);
      VecX z(problem.rows());
      for (double& v : z) v = random.normal();
      problem.r0 = Whitener(problem, noise).colour(z);
      const LoneEffect found = strongest_lone_input(problem, {});
      found_as_that += found.p_value < 1e-4 && found.input.equation == input.equation &&
                       found.input.axis == input.axis && found.input.tau == input.tau;
    }
    EXPECT_GE(found_as_that, 4) << equation_name(input.equation, input.axis);
  }
}

TEST(Evidence, IsThatOfTheProjectorWithTheColumnInTheMean) {
  Bench b(8.0);
  b.problem.r0 += b.problem.extra.col(2);
  NoiseModel noise;
  noise.acc_factor = 1.2;
  noise.drift_random_walk = 0.005 * deg_per_h / 60.0;
  const Evidence e = evidence_under(b.problem, b.set, noise, {0});
  LinearProblem with = b.problem.with_mean({0});
  with.extra = b.problem.extra.col(2);
  const Projector projector(with, noise);
  const double log_likelihood2 = projector.marginal().log_likelihood2();
  const Projected p = projector.candidates();
  EXPECT_NEAR(e.log_likelihood2, log_likelihood2, 1e-6 * std::abs(log_likelihood2));
  EXPECT_NEAR(e.gains[2].ratio, p.g[0] * p.g[0] / (1.0 + p.C(0, 0)), 1e-6 * e.gains[2].ratio);
}

}  // namespace
}  // namespace drift::inference::lone_input_test
