#pragma once

#include "core/estimate/ekf.hpp"

namespace drift {

/// An EKF, then the same measurements once more, linearised about what was found.
///
/// An EKF takes Jacobians at estimates that are still poor, and where parameters enter as products
/// (misalignment times drift or command) it ends surer than it should be (physics.md 5.9). The
/// second pass is a Kalman filter, linear in the deviations from a reference: the EKF's final
/// parameters, and the attitude integrated back with them from its estimate at the end of each
/// chain. Its result is that of a Gauss-Newton step on all data at once, and the sum of its NIS the
/// minimum of the linearised cost. While a pass moves some parameter by more than a posterior sigma
/// there is another, four at most; mostly there is one, at the cost of the EKF itself.
class IteratedEkf {
 public:
  /// The timeline must outlive the filter. start: library values of the initial estimate.
  IteratedEkf(const FilterSpec& filter, const Timeline& timeline, const Readout& readout,
              const Theta& start);

  /// Estimates from a whole recording; allocates nothing from the second time on.
  void run(const Measurements& measured, const Theta& start);

  EstimateStatus status() const { return status_; }
  const std::string& cause() const { return cause_; }
  double t_diverged() const { return t_diverged_; }  ///< [s]
  const InnovationSums& innovations() const { return sums_; }
  const VecX& x() const { return x_; }  ///< deviations from the prior means, in prior sigmas
  const Theta& theta() const { return theta_; }
  double sigma(std::size_t k) const {
    return layout_.sigma[static_cast<Eigen::Index>(k)] * std::sqrt(P_.variance(k));
  }
  /// Covariance of the states in prior sigmas, shape (size, size), without a copy.
  auto settled_covariance() {
    P_.settle();
    return P_.settled();
  }

 private:
  void first_pass(const Measurements& measured, const Theta& start);
  void linear_pass(const Measurements& measured);
  void place_reference();
  double largest_step() const;  ///< of the last pass, in posterior sigmas
  void process(std::size_t i, const Vec3& acc, const Vec3& gimbal);
  void diverge(std::string cause, double t);

  FilterSpec filter_;
  const Timeline& timeline_;
  Readout readout_;
  DriftModel model_;
  Layout layout_;
  Ekf ekf_;
  Linearizer linearizer_;
  IntervalSensitivity sensitivity_;
  Covariance P_;
  VecX x_, x_start_, x_reference_, dx_;  ///< dx: from the reference
  Vec3 psi_ = Vec3::Zero();              ///< attitude from the reference, inertial axes [rad]
  Theta theta_;
  Trajectory phi_;             ///< of the reference, at every node [rad]
  std::vector<Vec3> phi_end_;  ///< the EKF's, at the end of each chain [rad]
  Mat3X rest_G_;
  InnovationSums sums_;
  EstimateStatus status_ = EstimateStatus::ok;
  std::string cause_;
  double t_diverged_ = 0.0;
};

}  // namespace drift
