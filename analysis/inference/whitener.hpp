#pragma once

#include "analysis/inference/linear_problem.hpp"
#include "analysis/inference/noise/noise_model.hpp"

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
  Whitener(const MeasuredRows& rows, const NoiseModel& noise);

  /// Whitens columns that stand for rows first, first + 1, ...; before `first` they are zero.
  MatX apply(MatX columns, Eigen::Index first = 0) const;
  /// Products of all whitened columns with each other, lower triangle; the columns themselves are
  /// not kept.
  MatX products(const MatX& columns) const;
  /// The way back: unit white columns become noise with this covariance, attitude at its prior
  /// included.
  MatX colour(MatX white) const;
  /// log det of the covariance of all rows, attitude marginalised.
  double log_det() const { return log_det_; }

 private:
  /// Something that happens to the state in front of a row.
  struct Event {
    Eigen::Index row = 0;  ///< before this row
    bool cage = false;     ///< the attitude starts anew
    /// Otherwise the state moves: attitude += drive others, others *= decay.
    Eigen::Matrix<double, 3, Eigen::Dynamic> drive;
    VecX decay;
  };
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  /// Lets columns run through the filter: each row, and the state in front of it, is handed to
  /// `row`; some rows that are done, and the number of the first, to `done`.
  template <class Row, class Done>
  void run(const Eigen::Ref<const MatX>& columns, Eigen::Index first, Row&& row, Done&& done) const;
  void whiten_row(Eigen::Block<RowMajor, 1, Eigen::Dynamic, true> e, Eigen::Index k,
                  RowMajor& x) const;
  void move(const Event& event, RowMajor& x) const;

  int states_ = 3;
  std::vector<Event> events_;
  MatX H_, gain_;  ///< shape (states, rows)
  VecX root_;      ///< sigma of each innovation
  double log_det_ = 0.0;
};

}  // namespace drift::inference
