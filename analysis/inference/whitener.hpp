#pragma once

#include "analysis/inference/noise_filter.hpp"

namespace drift::inference {

/// Turns columns (residual, parameters, candidates) into innovations by a NoiseFilter. Equals
/// multiplication by the inverse Cholesky factor of the covariance of all rows (test).
class Whitener {
 public:
  Whitener(const MeasuredRows& rows, const NoiseModel& noise) : filter_(rows, noise) {}

  /// Whitens columns that stand for rows first, first + 1, ...; before `first` they are zero.
  MatX apply(MatX columns, Eigen::Index first = 0) const;
  /// The way back: unit white columns become noise with this covariance, attitude at its prior
  /// included.
  MatX colour(MatX white) const;
  /// log det of the covariance of all rows, attitude marginalised.
  double log_det() const { return filter_.log_det(); }

 private:
  NoiseFilter filter_;
};

}  // namespace drift::inference
