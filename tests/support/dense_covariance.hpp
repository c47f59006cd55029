#pragma once

#include <Eigen/Cholesky>
#include <vector>

#include "analysis/inference/noise_states.hpp"

namespace drift::test {

/// The covariance of all rows that a Whitener stands for, shape (rows, rows).
inline MatX dense_covariance(const inference::MeasuredRows& rows,
                             const inference::NoiseModel& noise) {
  // By definition: each row's weights on independent unit variables (prior, each step's noise).
  const inference::NoiseStates s(noise);
  MatX state(s.count, 0);
  const auto add = [&](const MatX& Q) {
    const Eigen::LDLT<MatX> ldlt(Q);
    MatX L = ldlt.matrixL();
    L = ldlt.transpositionsP().transpose() * L *
        ldlt.vectorD().cwiseMax(0.0).cwiseSqrt().asDiagonal();
    MatX wider(s.count, state.cols() + s.count);
    wider << state, L;
    state = wider;
  };
  MatX prior = inference::initial_covariance(s, noise);
  prior.topLeftCorner<3, 3>().setZero();
  add(prior);
  std::vector<VecX> weights(rows.rows());
  VecX white(rows.rows());
  inference::walk(
      rows, noise, s,
      [&](std::size_t) {
        state.topRows<3>().setZero();
        MatX fresh = MatX::Zero(s.count, s.count);
        fresh.topLeftCorner<3, 3>().setIdentity();
        add(fresh);
      },
      [&](const inference::NoiseStep& step) {
        state = (step.F * state).eval();
        add(step.Q);
      },
      [&](Eigen::Index k, const VecX& h, double sigma) {
        weights[k] = state.transpose() * h;
        white[k] = sigma * sigma;
      });
  MatX all = MatX::Zero(rows.rows(), state.cols());
  for (Eigen::Index k = 0; k < rows.rows(); ++k) all.row(k).head(weights[k].size()) = weights[k];
  MatX V = all * all.transpose();
  V.diagonal() += white;
  return V;
}

}  // namespace drift::test
