#include "analysis/inference/noise/noise_covariance.hpp"

#include <gtest/gtest.h>

#include <random>

namespace drift::inference::noise_covariance_test {
namespace {

/// Angle random walk, drift random walk and correlated accelerometer noise: 12 states, all used.
NoiseModel three_kinds() {
  NoiseModel n;
  n.angle_random_walk = 2e-6;
  n.drift_random_walk = 3e-10;
  n.acc_markov = 4e-6;
  return n;
}

IntervalDrive interval(std::mt19937& random) {
  std::normal_distribution<double> unit;
  IntervalDrive d;
  d.length = 60.0;
  d.gap = 5.0;
  for (int i = 0; i < 9; ++i) d.per_rate.data()[i] = 60.0 * unit(random);
  return d;
}

/// The same by textbook: P <- F P F' + Q.
MatX moved(const MatX& P, const NoiseStep& step) {
  const Eigen::Index n = P.rows(), others = n - 3;
  MatX F = MatX::Identity(n, n), Q = MatX::Zero(n, n);
  F.topRightCorner(3, others) = step.drive.leftCols(others);
  F.bottomRightCorner(others, others) = step.decay.head(others).asDiagonal();
  Q.bottomRightCorner(others, others) = step.variance.head(others).asDiagonal();
  if (step.kicked) {
    Q.topLeftCorner<3, 3>() += step.kick * step.kick.transpose();
    Q.block<3, 3>(0, 3) += step.kick;
    Q.block<3, 3>(3, 0) += step.kick.transpose();
  }
  Q.topLeftCorner<3, 3>() += step.anew * step.anew.transpose();
  return F * P * F.transpose() + Q;
}

TEST(NoiseCovariance, MovesAndTakesRowsAsTheTextbookDoes) {
  std::mt19937 random(7);
  std::normal_distribution<double> unit;
  const NoiseModel noise = three_kinds();
  const NoiseStates states(noise);
  ASSERT_EQ(states.count, 12);
  NoiseSteps steps(states, noise);
  NoiseCovariance<12> lanes(states, noise);
  MatX P = initial_covariance(states, noise);
  std::vector<double> gain(NoiseCovariance<12>::whole);
  for (int k = 0; k < 20; ++k) {
    const IntervalDrive d = interval(random);
    if (k == 10) {  // a new caging: the attitude alone is new
      lanes.begin(Anew::chain);
      P.topRows<3>().setZero();
      P.leftCols<3>().setZero();
      P.topLeftCorner<3, 3>().setIdentity();
    }
    for (const bool first_half : {true, false}) {
      const NoiseStep& step = steps.of(d, first_half);
      lanes.move(step);
      P = moved(P, step);
      for (const bool reads_others : {true, false}) {
        VecX h = VecX::Zero(12);
        h.head(reads_others ? 12 : 3).setRandom();
        const VecX Ph = P * h;
        const double S = h.dot(Ph) + 0.25;
        // Some fifty sums of numbers of its size each, twenty steps long.
        EXPECT_NEAR(lanes.take(h.data(), reads_others, 0.5, gain.data()), S, 1e-11 * S);
        const VecX expected = Ph / S;
        for (Eigen::Index i = 0; i < 12; ++i)
          EXPECT_NEAR(gain[static_cast<std::size_t>(i)], expected[i], 1e-11 * expected.norm());
        P -= Ph * Ph.transpose() / S;
      }
    }
  }
}

}  // namespace
}  // namespace drift::inference::noise_covariance_test
