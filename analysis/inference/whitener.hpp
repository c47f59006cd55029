#pragma once

#include "analysis/inference/linear_problem.hpp"

namespace drift::inference {

/// Turns columns (residual, parameters, candidates) into innovations: white and of unit variance
/// when the noise model is right.
///
/// One Kalman filter whose gains depend on the noise alone; every column runs through them (Willsky
/// and Jones 1976; discovery.md 2.1). States: attitude error (new at each caging, unit prior), and
/// as the noise asks for them drift random walk, Markov drift, correlated accelerometer noise.
/// Equals multiplication by the inverse Cholesky factor of the covariance of all rows (test).
class Whitener {
 public:
  Whitener(const LinearProblem& problem, const NoiseModel& noise);

  /// Whitens columns that stand for rows first, first + 1, ...; before `first` they are zero.
  MatX apply(const MatX& columns, Eigen::Index first = 0) const;
  /// The way back: unit white columns become noise with this covariance, attitude at its prior
  /// included.
  MatX colour(const MatX& white) const;
  /// log det of the covariance of all rows, attitude marginalised.
  double log_det() const { return log_det_; }

 private:
  /// Something that happens to the state in front of a row.
  struct Event {
    Eigen::Index row = 0;  ///< before this row
    bool cage = false;     ///< the attitude starts anew
    MatX F;                ///< otherwise the state moves; shape (states, states)
  };

  int states_ = 3;
  std::vector<Event> events_;
  MatX H_, gain_;  ///< shape (states, rows)
  VecX root_;      ///< sigma of each innovation
  double log_det_ = 0.0;
};

/// The covariance that a Whitener stands for, shape (rows, rows): slow, for tests and small
/// problems.
MatX dense_covariance(const LinearProblem& problem, const NoiseModel& noise);

}  // namespace drift::inference
