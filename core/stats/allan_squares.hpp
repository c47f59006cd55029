#pragma once

#include <Eigen/Core>
#include <array>

#include "core/stats/allan_covariance.hpp"

namespace drift::stats {

/// Which of the five noises are in a model.
using AllanSet = std::array<bool, allan_noises>;

/// A ramp alone is no noise.
inline bool has_noise(const AllanSet& set) {
  return set[0] || set[1] || set[2] || set[3];
}

/// Allan variances an octave apart, what a coefficient of one adds to each, and their covariance.
struct AllanProblem {
  Eigen::VectorXd variances;
  Eigen::Matrix<double, Eigen::Dynamic, allan_noises> slopes;
  const AllanCovariance& covariance;
};

/// Squares of the coefficients, none negative, with their covariance (zero where not estimated).
struct AllanEstimate {
  AllanSquares squares = AllanSquares::Zero();
  Eigen::Matrix<double, allan_noises, allan_noises> covariance =
      Eigen::Matrix<double, allan_noises, allan_noises>::Zero();
  double chi_square = 0.0;
  double surprise = 0.0;    ///< chi-square and the log determinant of the covariance
  Eigen::MatrixXd weights;  ///< squares = weights * variances, rows of those not in the set zero
};

/// Generalised least squares for the noises of `set` alone, signs free, under a given covariance of
/// the variances.
AllanEstimate free_estimate(const AllanProblem& problem, const AllanSet& set,
                            const Eigen::MatrixXd& covariance);

/// The best estimate without a negative square, its own noise in the covariance: repeated until it
/// stays.
AllanEstimate estimate_squares(const AllanProblem& problem, const AllanSet& set);

}  // namespace drift::stats
