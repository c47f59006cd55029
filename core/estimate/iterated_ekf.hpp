#pragma once

#include "core/estimate/ekf.hpp"
#include "core/estimate/reference_path.hpp"

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

  EstimateStatus status() const { return last().status(); }
  const std::string& cause() const { return last().cause(); }
  double t_diverged() const { return last().t_diverged(); }  ///< [s]
  const InnovationSums& innovations() const { return last().innovations(); }
  const VecX& x() const { return x_; }  ///< deviations from the prior means, in prior sigmas
  const Theta& theta() const { return theta_; }
  double sigma(std::size_t k) const { return linear_.sigma(k); }  ///< of state k, SI
  /// Covariance of the states in prior sigmas, shape (size, size), without a copy.
  auto settled_covariance() {
    linear_.covariance().settle();
    return linear_.covariance().settled();
  }

 private:
  void extended_pass(const Measurements& measured, const Theta& start);
  void linear_pass(const Measurements& measured);
  double largest_step() const;  ///< of the last pass, in posterior sigmas
  /// The pass that ended the run.
  const IntervalStep& last() const {
    return extended_.status() == EstimateStatus::ok ? linear_ : extended_;
  }

  const Timeline& timeline_;
  IntervalStep extended_, linear_;
  ReferencePath reference_;
  VecX x_, x_start_, x_reference_, dx_;  ///< dx: of the start from the reference
  Theta theta_;
};

}  // namespace drift
