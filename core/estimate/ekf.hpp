#pragma once

#include <cmath>

#include "core/estimate/covariance.hpp"
#include "core/estimate/estimate_result.hpp"
#include "core/estimate/gimbal_prediction.hpp"
#include "core/estimate/innovation_sums.hpp"
#include "core/estimate/linearize.hpp"
#include "core/sim/measurements.hpp"

namespace drift {

/// How an EKF run went, one entry per interval.
struct EkfHistory {
  std::vector<double> t;     ///< [s]
  MatX estimate;             ///< parameters in layout order, SI, shape (size, intervals)
  MatX sigma;                ///< shape (size, intervals)
  std::vector<double> nis;   ///< normalised innovation squared of the interval
  std::vector<int> scalars;  ///< measured scalars it sums over
};

/// Whether an EKF writes down how it went.
enum class KeepHistory { yes, no };

/// Continuous-discrete extended Kalman filter over 3 attitude errors and the layout's parameters.
///
/// Between samples the platform equation is integrated at the running estimate; the mean specific
/// force is taken in at the middle of its interval (exact to second order in the attitude change),
/// the gimbal angles at its end. Caging brings a new attitude within the prior
/// (physics.md 3.5, 6.6).
class Ekf {
 public:
  /// The timeline must outlive the filter. start: library values of the initial estimate.
  Ekf(const FilterSpec& filter, const Timeline& timeline, const Readout& readout,
      const Theta& start, KeepHistory keep = KeepHistory::yes);

  /// As if built anew from this start; allocates nothing.
  void reset(const Theta& start);

  /// Takes in the measurements of interval i; intervals come in order.
  void process(std::size_t i, const Vec3& acc, const Vec3& gimbal);

  EstimateResult result() const;
  const EkfHistory& history() const { return history_; }  ///< empty unless kept
  const InnovationSums& innovations() const { return sums_; }
  EstimateStatus status() const { return status_; }
  const std::string& cause() const { return cause_; }
  double t_diverged() const { return t_diverged_; }  ///< [s]
  double sigma(std::size_t k) const {
    return layout_.sigma[k] * std::sqrt(P_.variance(k));
  }                                     ///< of state k, SI
  const VecX& x() const { return x_; }  ///< deviations from the prior means, in prior sigmas
  const Layout& layout() const { return layout_; }
  const Covariance& covariance() const { return P_; }
  /// Covariance of the states in prior sigmas, shape (size, size), without a copy. At the end of a
  /// run.
  auto settled_covariance() {
    P_.settle();
    return P_.settled();
  }
  const Theta& theta() const { return theta_; }
  /// Estimated rotation vector of the platform against the reference, at the last sample [rad].
  const Vec3& phi() const { return phi_; }

 private:
  void correct_attitude(const Node& node, const Vec3& psi_i, Vec3& phi) const;
  void take(const Covariance::Update& update, std::size_t i, InnovationSums::Channel channel);
  void learn();
  Vec3 gated(const Vec3& nu, const Mat3& H_psi, const Mat3X& H_par, double sigma) const;

  FilterSpec filter_;
  const Timeline& timeline_;
  Readout readout_;
  DriftModel model_;
  Layout layout_;
  Linearizer linearizer_;
  IntervalSensitivity sensitivity_;
  MemoryPath memory_;
  Covariance P_;
  VecX x_, start_;
  Theta theta_;
  Vec3 phi_ = Vec3::Zero();
  Mat3X rest_G_;  ///< work
  std::vector<Vec3> nodes_;
  EkfHistory history_;
  KeepHistory keep_;
  InnovationSums sums_;
  EstimateStatus status_ = EstimateStatus::ok;
  std::string cause_;
  double t_diverged_ = 0.0;
};

/// Runs the filter over a whole recording.
EstimateResult run_ekf(const FilterSpec& filter, const Timeline& timeline, const Readout& readout,
                       const Measurements& measured, const Theta& start,
                       EkfHistory* history = nullptr);

}  // namespace drift
