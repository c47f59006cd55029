#pragma once

#include "analysis/inference/linear_problem.hpp"
#include "analysis/inference/noise/noise_model.hpp"
#include "core/base/rng.hpp"

namespace drift::test {

/// Two cagings of two positions each, five intervals a position, all six channels read; every
/// derivative drawn. One row is trusted less.
inline inference::LinearProblem random_problem(Eigen::Index parameters, Eigen::Index candidates) {
  constexpr int positions = 4, intervals = 5;
  Stream random(31, 0, Purpose::test);
  const auto normal = [&](Eigen::Index r, Eigen::Index c) {
    MatX m(r, c);
    for (double& v : m.reshaped()) v = random.normal();
    return m;
  };
  inference::LinearProblem p;
  p.attitude_sigma = 1e-3;
  for (int position = 0; position < positions; ++position)
    for (int k = 0; k < intervals; ++k) {
      inference::IntervalDrive drive;
      drive.length = 60.0;
      drive.gap = k == 0 && position % 2 == 1 ? 120.0 : 0.0;
      drive.cage = k == 0 && position % 2 == 0;
      drive.chain = position / 2;
      drive.per_rate = drive.length / p.attitude_sigma * normal(3, 3);
      for (int channel = 0; channel < inference::num_channels; ++channel)
        p.tags.push_back({p.drives.size(), channel, position});
      p.drives.push_back(drive);
    }
  const auto rows = static_cast<Eigen::Index>(p.tags.size());
  p.psi = 3.0 * normal(rows, 3);
  p.theta = normal(rows, parameters);
  p.extra = normal(rows, candidates);
  p.r0 = 2.0 * normal(rows, 1);
  p.weight = VecX::Ones(rows);
  p.weight[7] = 0.4;
  p.acc_sigma = 5e-6;
  p.gimbal_sigma = 2.5e-5;
  return p;
}

/// All kinds of noise, each about as large as the white noise in the rows of random_problem().
inline inference::NoiseModel every_noise() {
  inference::NoiseModel n;
  n.acc_factor = 1.3;
  n.gimbal_factor = 0.8;
  n.angle_random_walk = 1e-5;
  n.drift_random_walk = 1e-6;
  n.markov_drift = 5e-6;
  n.markov_tau = 300.0;
  n.acc_markov = 4e-6;
  n.acc_tau = 200.0;
  return n;
}

}  // namespace drift::test
