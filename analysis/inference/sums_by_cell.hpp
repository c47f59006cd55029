#pragma once

#include "analysis/inference/projector.hpp"

namespace drift::inference {

/// What a Projector says of a linearised test, as often as asked with other rows left out, for
/// white noise: the sums of products of its columns are kept for every cell, the rows of one
/// position in one chain, and what is left of them is added up. With U, W the scaled columns of a
/// chain and P what its rows feel of the attitude, U' V^-1 W = U'W - U'P (1 + P'P)^-1 P'W
/// (Woodbury).
class SumsByCell {
 public:
  /// Noise that drives the platform ties the rows of a chain together.
  static bool can(const NoiseModel& noise) { return !noise.driven(); }

  SumsByCell(const LinearProblem& problem, const NoiseModel& noise);

  /// Of the rows in intervals that are not marked, each cell whole or not at all. with: candidates
  /// that are parameters too, a ~ N(0, I).
  Marginal marginal(const std::vector<bool>& left_out, const std::vector<int>& with = {}) const;
  Projected candidates(const std::vector<bool>& left_out) const;

 private:
  struct Cell {
    int chain = 0;
    std::vector<std::size_t> intervals;  ///< with rows, ascending
    Eigen::Index rows = 0;
    double log_det = 0.0;  ///< of the white noise
    MatX products;         ///< of [psi, theta, extra, r0], lower triangle
  };
  /// The cells that are left, added up and the attitudes eliminated.
  struct Sum {
    MatX products;  ///< of [theta, extra, r0], lower triangle
    double log_det = 0.0;
    Eigen::Index rows = 0;
  };
  Sum sum_without(const std::vector<bool>& left_out) const;

  Eigen::Index n_, extra_;  ///< parameters, candidates
  std::vector<Cell> cells_;
};

}  // namespace drift::inference
