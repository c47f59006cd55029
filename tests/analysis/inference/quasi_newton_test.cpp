#include "analysis/inference/noise/quasi_newton.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace drift::inference::quasi_newton_test {
namespace {

TEST(QuasiNewton, FindsTheTopOfAParabolaAndItsCurvature) {
  MatX A(2, 2);
  A << 40.0, 12.0, 12.0, 20.0;
  const VecX top = VecX::Constant(2, 0.7);
  const Maximum m =
      maximise([&](const VecX& x) { return 5.0 - 0.5 * (x - top).dot(A * (x - top)); },
               VecX::Zero(2), MatX(A.diagonal().cwiseInverse().asDiagonal()));
  // It stands still when a step gains less than 1e-3, and differences forward by 1e-3 move the top
  // by half of that.
  EXPECT_NEAR(m.value, 5.0, 1e-3);
  const VecX off = m.x - top;
  EXPECT_LT(off.dot(A * off), 2.0 * 1e-3);
  // Secants of a parabola are exact; each update of the two-by-two curvature keeps one of them.
  const MatX found = m.inverse_curvature * A;
  EXPECT_LT((found - MatX::Identity(2, 2)).cwiseAbs().maxCoeff(), 0.05);
}

TEST(QuasiNewton, FindsTheLogOfASigma) {
  // n draws of square sum q: n log sigma + q / (2 sigma^2), least at sigma^2 = q / n, where the
  // second derivative by log sigma is 2 n.
  constexpr double n = 200.0, q = 200.0 * 9.0;
  const auto log_likelihood = [](const VecX& x) {
    return -n * x[0] - 0.5 * q * std::exp(-2.0 * x[0]);
  };
  const Maximum m = maximise(log_likelihood, VecX::Zero(1), MatX::Constant(1, 1, 0.5 / n));
  EXPECT_NEAR(m.x[0], std::log(3.0), std::sqrt(1e-3 / n) + 0.5e-3);
}

TEST(QuasiNewton, ASmallStepThatGainsWhatItPromisedIsTheLast) {
  // The curvature is given 1.2 times too large; a step promises 0.5 g^2 / 1.2 a = 0.008. What is
  // left of it is a thirtieth, below what counts, and the curvature is read off the gain.
  constexpr double a = 50.0;
  int calls = 0;
  const auto parabola = [&](const VecX& x) {
    ++calls;
    return -0.5 * a * x[0] * x[0];
  };
  const double begin = std::sqrt(2.0 * 1.2 * 0.008 / a);
  const Maximum m =
      maximise(parabola, VecX::Constant(1, begin), MatX::Constant(1, 1, 1.0 / (1.2 * a)));
  EXPECT_EQ(calls, 3);  // the beginning, its slope, the step
  EXPECT_GT(m.value, -1e-3);
  // Differences forward by 1e-3 have the slope too large by 1e-3 / 2 of the begin, and what it
  // promises and gains makes three times as much of it.
  EXPECT_NEAR(m.inverse_curvature(0, 0) * a, 1.0, 3.0 * 0.5e-3 / begin);
}

TEST(QuasiNewton, StaysWhereNothingIsBetter) {
  const Maximum m = maximise([](const VecX& x) { return x.norm() > 0.0 ? -1.0 : 0.0; },
                             VecX::Zero(2), MatX::Identity(2, 2));
  EXPECT_EQ(m.x, VecX::Zero(2));
  EXPECT_EQ(m.value, 0.0);
}

}  // namespace
}  // namespace drift::inference::quasi_newton_test
