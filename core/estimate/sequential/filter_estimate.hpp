#pragma once

#include <string>

#include "core/estimate/estimate_result.hpp"

namespace drift {

/// What a filter has found in a recording. All but status, cause and time of the divergence counts
/// where it has not diverged.
class FilterEstimate {
 public:
  EstimateStatus status() const { return status_; }
  const std::string& cause() const { return cause_; }
  double t_diverged() const { return t_diverged_; }  ///< [s]
  double nis() const { return nis_; }  ///< sum of its innovations squared; iterated: least cost
  std::size_t scalars() const { return scalars_; }  ///< measured scalars it sums over
  /// Correlation of whitened residuals of one channel, one sample apart, less what the fit makes
  /// of white ones: 0 on average for a right model, with standard deviation 1 / sqrt(scalars) or a
  /// little more (physics.md 5.6).
  double lag1() const { return lag1_; }
  const VecX& x() const { return x_; }  ///< deviations from the prior means, in prior sigmas
  const Theta& theta() const { return theta_; }
  double sigma(std::size_t k) const { return sigma_[static_cast<Eigen::Index>(k)]; }  ///< SI
  /// Covariance of the states in prior sigmas, shape (size, size).
  const MatX& settled_covariance() const { return P_; }

 protected:
  /// Nothing is known yet of this recording.
  void begin_anew() {
    status_ = EstimateStatus::ok;
    cause_.clear();
    t_diverged_ = nis_ = lag1_ = 0.0;
  }

  EstimateStatus status_ = EstimateStatus::ok;
  std::string cause_;
  double t_diverged_ = 0.0, nis_ = 0.0, lag1_ = 0.0;
  std::size_t scalars_ = 0;
  VecX x_, sigma_;
  MatX P_;
  Theta theta_ = Theta::Zero();
};

}  // namespace drift
