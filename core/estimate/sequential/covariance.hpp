#pragma once

#include <vector>

#include "core/estimate/rows3.hpp"

namespace drift {

using MatX3 = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// Covariance of 3 attitude errors and n static parameters, of which the first `num_rate` act on
/// the attitude's rate. Because the parameters stand still, a step costs about 3 n^2
/// multiplications where a dense filter spends 2 (n+3)^3 (physics.md 6.6, 1512.03077). Allocates
/// only when built.
///
/// Every operation is symmetric term by term, so P_pp stays symmetric to the last bit.
class Covariance {
 public:
  /// Attitude of sigma_attitude [rad] per axis; parameters of unit variance (scaled by their
  /// prior).
  Covariance(std::size_t parameters, std::size_t num_rate, double sigma_attitude);

  /// As it was when built.
  void reset(double sigma_attitude);

  /// A new attitude, unknown within sigma [rad]; the parameters keep what is known of them.
  void recage(double sigma_attitude);

  /// psi <- Phi psi + G x(rate). G has shape (3, num_rate). What drives the attitude is held, and
  /// comes by drive().
  void propagate(const Mat3& Phi, const Eigen::Ref<const Rows3>& G);

  /// The noise n of another sample (HeldNoise), of that variance in each axis, independent of all
  /// before. Forgotten by recage() and reset().
  void hold(double variance);
  /// psi <- psi + N n, after propagate().
  void drive(const Mat3& N);
  /// The attitude gains a covariance that nothing before it feels [rad^2].
  void disturb(const Mat3& covariance) { P_aa_ += covariance; }

  /// Adds variance to one parameter (drift random walk).
  void add_variance(std::size_t parameter, double variance) {
    P_pp_(parameter, parameter) += variance;
  }

  /// A parameter becomes what another one is, whatever it was.
  void set_equal(std::size_t parameter, std::size_t other);

  /// The outcome of an update with m <= 3 scalars.
  struct Update {
    Vec3 attitude = Vec3::Zero();  ///< correction psi_i [rad]
    Vec3 held = Vec3::Zero();      ///< correction of the noise that is held
    double nis = 0.0;              ///< normalised innovation squared
    Vec3 white = Vec3::Zero();     ///< innovation whitened: L^-1 nu; zero where not measured
    int scalars = 0;
    bool ok = true;  ///< false: innovation covariance not positive definite
  };

  /// Measurement of m scalars: innovation nu, H = [H_psi, H_rate on the first num_rate parameters,
  /// H_par on those after them], independent noise of standard deviation sigma. NaN innovations are
  /// left out. The parameter correction is added to x. H_rate and H_par may be empty. H_held: by
  /// the noise that is held, null where it does not act.
  Update update(const Vec3& nu, const Mat3& H_psi, const Eigen::Ref<const Rows3>& H_rate,
                const Eigen::Ref<const Rows3>& H_par, double sigma, VecX& x,
                const Mat3* H_held = nullptr);

  const Mat3& attitude() const { return P_aa_; }
  MatX parameters() const;
  /// Brings P_pp up to date, so that settled() may be read; rounding of later updates may differ.
  void settle();
  auto settled() const { return P_pp_.topRows(P_pp_.cols()); }  ///< shape (parameters, parameters)
  double variance(std::size_t parameter) const {
    const double owed = owed_ ? gain_.row(parameter).squaredNorm() : 0.0;
    return P_pp_(parameter, parameter) - owed;
  }
  auto cross() const { return P_pa_.topRows(P_pp_.cols()); }  ///< shape (parameters, 3)

 private:
  std::size_t num_rate_;
  // Rows are filled up with zeros to whole lanes.
  Mat3 P_aa_;
  MatX3 P_pa_;
  MatX P_pp_;
  MatX3 work_, gain_, later_gain_;
  bool holds_ = false;
  Mat3 P_nn_, P_na_;  ///< of the noise that is held, and with the attitude
  MatX3 P_pn_;
  Rows3 H_rate_;  ///< without the rows that were not measured
  /// An element of H_par that is not zero.
  struct Entry {
    Eigen::Index column;  ///< counts parameters
    double value;
  };
  std::vector<Entry> entries_;
  // The matrix hardly fits the first cache, so it is written as seldom as possible: an update may
  // leave P_pp too large by gain gain^T, which the next one takes off along with its own.
  bool owed_ = false;
};

}  // namespace drift
