#include "analysis/inference/whitener.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <limits>

#include "analysis/inference/signatures.hpp"
#include "tests/support/dense_covariance.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::inference::whitener_test {
namespace {

using namespace drift::test;

/// A short real test, linearised: two or more cagings, accelerometers and gimbals.
LinearProblem short_problem() {
  static const Timeline timeline = preset_timeline("six", CommandLaw::free, 600.0, 60.0);
  const Readout readout;
  const FilterSpec filter = base_filter(Coupling::eq5);
  Measurements measured =
      Simulator(base_truth(Coupling::eq5), readout).run(timeline, 5, 0).measured;
  measured.acc(1, 3) = std::nan("");  // a sample that was not measured
  measured.gimbal(2, 7) = std::nan("");
  const BatchResult fit =
      fit_batch(filter, {timeline, readout, measured}, make_layout(filter).theta);
  return linear_problem(filter, {timeline, readout, measured}, fit, {});
}

/// The same as two recordings of three positions each.
LinearProblem two_recordings() {
  LinearProblem problem = short_problem();
  IntervalDrive& fourth = problem.drives[problem.drives.size() / 2];
  EXPECT_TRUE(fourth.cage);
  fourth.begins = true;
  return problem;
}

/// Exact: L^-1 X with V = L L', rows in the order of time.
void expect_equals_cholesky(const NoiseModel& noise, LinearProblem problem) {
  problem.weight[5] = 0.3;
  const Whitener whitener(problem, noise);
  const Eigen::LLT<MatX> llt(DenseCovariance(problem, noise).all());
  ASSERT_EQ(llt.info(), Eigen::Success);
  const MatX L = llt.matrixL();
  const MatX expected = L.triangularView<Eigen::Lower>().solve(problem.theta);
  // Two ways of solving with V, condition number up to (200 arcsec / 5 arcsec)^2 x rows, about 1e6.
  EXPECT_LT((whitener.apply(problem.theta) - expected).cwiseAbs().maxCoeff(),
            1e-8 * expected.cwiseAbs().maxCoeff());
  EXPECT_NEAR(whitener.log_det(), 2.0 * L.diagonal().array().log().sum(),
              1e-7 * static_cast<double>(problem.rows()));
}
void expect_equals_cholesky(const NoiseModel& noise) {
  expect_equals_cholesky(noise, short_problem());
  expect_equals_cholesky(noise, two_recordings());
}

TEST(Whitener, EqualsDenseCholeskyForWhiteNoise) {
  expect_equals_cholesky({});
}

TEST(Whitener, EqualsDenseCholeskyForEveryKindOfNoiseAtOnce) {
  NoiseModel noise;
  noise.acc_factor = 1.3;
  noise.gimbal_factor = 0.8;
  noise.angle_random_walk = 1e-3 * drift::detail::deg / 60.0;
  noise.drift_random_walk = 0.01 * deg_per_h / 60.0;
  noise.markov_drift = 0.02 * deg_per_h;
  noise.markov_tau = 1200.0;
  noise.caging_drift = 0.015 * deg_per_h;
  noise.acc_markov = 4e-6;
  noise.acc_tau = 200.0;
  expect_equals_cholesky(noise);
}

TEST(Whitener, EqualsDenseCholeskyForAnInputInOneEquation) {
  const double infinite = std::numeric_limits<double>::infinity();
  for (const LoneInput& lone : {LoneInput{Equation::rate, 1, 0.01 * deg_per_h / 60.0, infinite},
                                LoneInput{Equation::rate, 2, 0.01 * deg_per_h, 900.0},
                                LoneInput{Equation::accelerometer, 0, 3e-6, 300.0},
                                LoneInput{Equation::accelerometer, 1, 3e-6, LoneInput::constant},
                                LoneInput{Equation::gimbal, 2, 2e-5, 300.0}}) {
    NoiseModel noise;
    noise.drift_random_walk = 0.005 * deg_per_h / 60.0;
    noise.lone = lone;
    expect_equals_cholesky(noise);
  }
}

TEST(Whitener, ColoursWhatItWhitens) {
  NoiseModel noise;
  noise.angle_random_walk = 1e-3 * drift::detail::deg / 60.0;
  noise.markov_drift = 0.02 * deg_per_h;
  noise.lone = {Equation::accelerometer, 1, 3e-6, 300.0};
  const LinearProblem problem = short_problem();
  const Whitener whitener(problem, noise);
  const MatX back = whitener.colour(whitener.apply(problem.theta));
  // Forth and back through one filter: rounding alone, times the number of rows.
  EXPECT_LT((back - problem.theta).cwiseAbs().maxCoeff(),
            1e-10 * problem.theta.cwiseAbs().maxCoeff());
}

TEST(Whitener, WithoutProcessNoiseAChainDoesNotSeeAnother) {
  // Only the attitude is then a state, and it starts anew with each caging.
  const LinearProblem problem = short_problem();
  MatX one = MatX::Zero(problem.rows(), 1);
  one(2, 0) = 1.0;
  const VecX white = Whitener(problem, {}).apply(one);
  for (Eigen::Index k = 0; k < problem.rows(); ++k)
    if (problem.tags[k].position > 0) {
      EXPECT_EQ(white[k], 0.0) << k;
    }
  EXPECT_NE(white[8], 0.0);
}

TEST(Whitener, ARecordingDoesNotSeeTheOneBeforeWhateverTheNoise) {
  NoiseModel noise;
  noise.drift_random_walk = 0.01 * deg_per_h / 60.0;
  noise.markov_drift = 0.02 * deg_per_h;
  noise.acc_markov = 4e-6;
  noise.lone = {Equation::accelerometer, 0, 3e-6, 300.0};
  const LinearProblem problem = two_recordings();
  MatX one = MatX::Zero(problem.rows(), 1);
  one(0, 0) = 1.0;
  const VecX white = Whitener(problem, noise).apply(one);
  for (Eigen::Index k = 0; k < problem.rows(); ++k) {
    if (problem.tags[static_cast<std::size_t>(k)].position >= 3) {
      EXPECT_EQ(white[k], 0.0) << k;
    }
  }
  EXPECT_NE(Whitener(short_problem(), noise).apply(one)(problem.rows() - 1, 0), 0.0);
}

TEST(Whitener, ColumnsFromALaterRowOnAreTheSameAsZerosBefore) {
  NoiseModel noise;
  noise.drift_random_walk = 0.01 * deg_per_h / 60.0;
  const LinearProblem problem = short_problem();
  const Eigen::Index first = 40;
  MatX whole = MatX::Zero(problem.rows(), 2);
  whole.bottomRows(problem.rows() - first) =
      problem.theta.bottomRows(problem.rows() - first).leftCols(2);
  const Whitener whitener(problem, noise);
  EXPECT_EQ(whitener.apply(whole).bottomRows(problem.rows() - first),
            whitener.apply(whole.bottomRows(problem.rows() - first), first));
}

}  // namespace
}  // namespace drift::inference::whitener_test
