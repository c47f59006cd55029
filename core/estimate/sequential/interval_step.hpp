#pragma once

#include <cmath>
#include <string>

#include "core/estimate/estimate_result.hpp"
#include "core/estimate/linearize.hpp"
#include "core/estimate/sequential/covariance.hpp"
#include "core/estimate/sequential/innovation_sums.hpp"
#include "core/sim/held_noise.hpp"

namespace drift {

/// What a sequential estimator does with one sample interval: linearise, predict, gate, update.
///
/// Time, the memory of terms, terms in the gimbals, drift noise and outliers are dealt with here
/// alone, so that every sequential estimator knows of them. States are 3 attitude errors and the
/// parameters of the layout. The mean specific force is taken in at the middle of its interval, as
/// the mean over the path through that attitude; the gimbal angles, or what stands for them at
/// rest (predict_rest_rate), at its end. Caging brings a
/// new attitude within the prior (physics.md 3.5, 6.6).
class IntervalStep {
 public:
  /// The timeline must outlive the step.
  IntervalStep(const FilterSpec& filter, const Timeline& timeline, const Readout& readout);

  /// Before the first interval, with the covariance of the priors. x: the estimate, of the layout;
  /// theta: the parameters to linearise about. Allocates nothing.
  void reset(const VecX& x, const Theta& theta);

  /// What an interval has measured.
  struct Taken {
    double nis = 0.0;  ///< normalised innovation squared
    int scalars = 0;
  };
  /// Takes in the measurements of interval i; intervals come in order. Nothing once it has
  /// diverged.
  Taken process(std::size_t i, const Vec3& acc, const Vec3& gimbal);

  const Layout& layout() const { return layout_; }
  /// The estimate, in prior sigmas: deviations from the prior means. Of several recordings, behind
  /// the layout's states, what those that vary were at the beginning of the first; likewise in
  /// covariance().
  const VecX& x() const { return x_; }
  const Theta& theta() const { return theta_; }  ///< that the next interval is linearised about
  /// Estimated rotation vector of the platform against its nominal attitude, at the end of the last
  /// interval [rad].
  const Vec3& phi() const { return phi_; }
  Covariance& covariance() { return P_; }
  const Covariance& covariance() const { return P_; }
  double sigma(std::size_t k) const {
    return layout_.sigma[k] * std::sqrt(P_.variance(k));
  }  ///< of state k, SI
  const InnovationSums& innovations() const { return sums_; }
  EstimateStatus status() const { return status_; }
  const std::string& cause() const { return cause_; }
  double t_diverged() const { return t_diverged_; }  ///< [s]

 private:
  void linearise(std::size_t i);
  void predict(const Mat3& Phi, const Rows3& G, const Mat3& N);
  void take_accelerometers(const Interval& interval, const Vec3& acc);
  void take_gimbals(const Interval& interval, const Vec3& gimbal);
  /// How three scalars depend on the attitude, on the states and on the noise that is held (null:
  /// not at all); matrices may be empty.
  struct Sensitivity {
    const Mat3& psi;
    Eigen::Ref<const Rows3> rate;
    Eigen::Ref<const Rows3> par;
    const Mat3* held;
  };
  Sensitivity sensitivity_of(const Mat3& psi, const Rows3& rate, const Rows3& par) const;
  void update(const Interval& interval, std::size_t node, const Vec3& residual,
              const Sensitivity& H, double noise, InnovationSums::Channel channel);
  Vec3 gated(const Vec3& nu, const Sensitivity& H, double noise) const;
  void notice_divergence(const Covariance::Update& update, double t);
  void learn();
  void let_drift_vary(double duration);
  void let_drift_begin_anew();
  const MemoryPoint* memory_at(std::size_t node) const;

  FilterSpec filter_;
  const Timeline& timeline_;
  Readout readout_;
  DriftModel model_;
  Layout layout_;
  std::vector<std::size_t> walking_;  ///< states whose value is not constant
  Linearizer linearizer_;
  IntervalSensitivity sensitivity_;
  MemoryPath memory_;
  std::size_t beginnings_;  ///< states behind the layout's, which nothing reads: see x()
  Covariance P_;
  VecX x_;
  Theta theta_ = Theta::Zero();
  Vec3 phi_ = Vec3::Zero();
  std::vector<Vec3> nodes_;    ///< rotation vector of the estimate at the interval's nodes [rad]
  HeldNoise held_;             ///< of the interval
  Vec3 noise_ = Vec3::Zero();  ///< estimate of what is held
  Rows3 rest_G_;               ///< work
  MeanOutput mean_;            ///< work
  Taken taken_;
  InnovationSums sums_;
  EstimateStatus status_ = EstimateStatus::ok;
  std::string cause_;
  double t_diverged_ = 0.0;
};

}  // namespace drift
