#include "analysis/inference/size_prior.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <array>
#include <cmath>

namespace drift::inference::size_prior_test {
namespace {

constexpr std::array scales{1.0, 0.3, 0.1, 0.03, 0.01};

TEST(SizePrior, EvidenceIsTheIntegralOverTheMixture) {
  // One amplitude, the likelihood ratio exp(g a - C a^2 / 2): by the trapezoid rule, exact for
  // Gaussians.
  const double C = 400.0, g = 60.0;
  double integral = 0.0;
  for (const double s : scales) {
    const double step = 0.01 * std::min(s, 1.0 / std::sqrt(C));
    for (double a = -8.0 * s; a <= 8.0 * s; a += step)
      integral += step * std::exp(g * a - 0.5 * C * a * a - 0.5 * a * a / (s * s)) /
                  (s * std::sqrt(2.0 * M_PI));
  }
  const double expected = std::log(integral / scales.size());
  EXPECT_NEAR(log_evidence_of_sizes(MatX::Constant(1, 1, C), VecX::Constant(1, g)), expected, 1e-6);
}

TEST(SizePrior, SharpEyesAreNoDisadvantage) {
  // The same score of 8 sigma, seen 30 times as sharply: with one prior sigma it would lose log 30
  // = 3.4.
  const auto evidence = [](double C) {
    return log_evidence_of_sizes(MatX::Constant(1, 1, C), VecX::Constant(1, 8.0 * std::sqrt(C)));
  };
  EXPECT_LT(std::abs(evidence(100.0) - evidence(90000.0)), 1.0);
  // A size that would have to be unphysical still loses: 8 sigma at ten prior sigmas.
  EXPECT_LT(evidence(0.64), evidence(100.0) - 10.0);
}

TEST(SizePrior, ChangingThePriorOfAFitGivesTheSameEvidence) {
  MatX C(2, 2);
  C << 900.0, 200.0, 200.0, 2500.0;
  const VecX g = C * Eigen::Vector2d(0.2, -0.05);
  const MatX covariance = (C + MatX::Identity(2, 2)).inverse();
  const VecX x = covariance * g;
  const double unit = 0.5 * g.dot(x) - 0.5 * std::log((C + MatX::Identity(2, 2)).determinant());
  EXPECT_NEAR(unit + log_gain_of_sizes(x, covariance, {0, 0}), log_evidence_of_sizes(C, g), 1e-9);

  // Two causes: every scale of the one with every scale of the other.
  double sum = 0.0;
  for (const double s : scales)
    for (const double t : scales) {
      MatX A = C;
      A(0, 0) += 1.0 / (s * s);
      A(1, 1) += 1.0 / (t * t);
      sum += std::exp(0.5 * g.dot(A.llt().solve(g)) -
                      0.5 * std::log(A.determinant() * s * s * t * t)) /
             25.0;
    }
  EXPECT_NEAR(unit + log_gain_of_sizes(x, covariance, {0, 1}), std::log(sum), 1e-9);
}

TEST(SizePrior, FarBeyondItIsAScaleOfItsOwnWithTheChanceThatAPriorLeaves) {
  // 40 prior sigmas, seen at 80 sigma of the test. Of the wide prior alone, by hand.
  const double C = 4.0, a = 40.0, s2 = a * a;
  const double wide = 0.5 * (C * a) * (C * a) / (1.0 / s2 + C) - 0.5 * std::log1p(s2 * C);
  const double share = std::erfc(5.0 / std::sqrt(2.0)) * (5.0 / a) * (5.0 / a);
  EXPECT_NEAR(share_of_sizes(a), share, 1e-15);
  EXPECT_NEAR(log_evidence_of_sizes(MatX::Constant(1, 1, C), VecX::Constant(1, C * a)),
              wide + std::log(share), 1e-6);
  // At five prior sigmas nothing has changed: one scale, the largest, has it all.
  const double at_five = 0.5 * 400.0 / 5.0 - 0.5 * std::log(5.0) - std::log(5.0);
  EXPECT_NEAR(log_evidence_of_sizes(MatX::Constant(1, 1, C), VecX::Constant(1, C * 4.999)), at_five,
              0.1);
}

TEST(SizePrior, AFitUnderAWiderPriorHasTheSameEvidence) {
  const double C = 4.0, a = 40.0;
  // What a fit says in units of a prior of 40 sigmas: information and gradient of amplitude / 40.
  const MatX wide_C = MatX::Constant(1, 1, C * a * a);
  const VecX wide_g = VecX::Constant(1, C * a * a);
  const MatX covariance = (wide_C + MatX::Identity(1, 1)).inverse();
  const VecX x = covariance * wide_g;
  const double unit = 0.5 * wide_g.dot(x) - 0.5 * std::log(wide_C(0, 0) + 1.0);
  EXPECT_NEAR(unit + log_gain_of_sizes(x, covariance, {0}, {a}),
              log_evidence_of_sizes(MatX::Constant(1, 1, C), VecX::Constant(1, C * a)), 1e-9);
}

TEST(SizePrior, WithoutItsPriorAFitIsWhatTheDataSay) {
  // 40 +- 4.5 of the data and a prior of 0 +- 5, combined and taken apart again.
  constexpr double data = 40.0, s = 4.5, prior = 5.0;
  const double variance = 1.0 / (1.0 / (s * s) + 1.0 / (prior * prior));
  const double fit = variance * data / (s * s);
  EXPECT_LT(fit, 5.0 * prior) << "held back to where its prior seems to explain it";
  const DataAlone alone = without_prior(fit, std::sqrt(variance), prior);
  EXPECT_NEAR(alone.off, data, 1e-12 * data);
  EXPECT_NEAR(alone.sigmas, data / std::hypot(s, prior), 1e-12 * data);
}

TEST(SizePrior, WhatMayHaveBeenMadeSmallLosesNothingByBeingThere) {
  // Six amplitudes that a test sees to a thousandth of their prior, and does not find. As large as
  // their prior they would be a coincidence of 6 log(1000); of eight scales, the least of which it
  // does not see (0.3 of its sigma: 3 log(1.09)), they cost no more than log 8 and that.
  const int n = 6;
  const double s = 1e-3;
  const VecX x = VecX::Zero(n);
  const MatX covariance = s * s / (1.0 + s * s) * MatX::Identity(n, n);
  const double unit = n * std::log(s);  // log evidence with the prior, against none
  const double whole = unit + log_gain_of_sizes_made_small(x, covariance);
  EXPECT_GE(whole, -std::log(8.0) - 3.0 * std::log(1.09) - 1e-3);
  EXPECT_LE(whole, 0.0);
  EXPECT_LT(unit + log_gain_of_sizes(x, covariance, std::vector<int>(n, 0)), -13.0);
}

}  // namespace
}  // namespace drift::inference::size_prior_test
