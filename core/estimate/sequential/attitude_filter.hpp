#pragma once

#include <optional>
#include <vector>

#include "core/estimate/rows3.hpp"
#include "core/estimate/sequential/information.hpp"

namespace drift {

/// A Kalman filter of what moves, whose innovations are linear in what stands still.
///
/// States: 3 attitude errors and, where drift walks, as many further ones, what the walk has added
/// to some parameters. Their estimate hangs on the static parameters x (deviations from a
/// reference), z = a + U x, and gains depend on the noise alone; so every measurement gives
/// whitened rows [t | e] of a static least squares problem, |t x - e|^2, process noise and new
/// attitudes at cagings included (Friedland, IEEE TAC 14(4), 1969). Columns are the parameters,
/// then the right hand side, then zeros up to whole lanes.
class AttitudeFilter {
 public:
  static constexpr int most_walking = 3;
  using Moving = Eigen::Matrix<double, 3 + most_walking, 3 + most_walking>;

  /// walking: parameters whose value walks, at most three, none of them twice.
  AttitudeFilter(std::size_t parameters, std::vector<std::size_t> walking);

  std::size_t width() const { return width_; }       ///< of a row, whole lanes
  std::size_t right() const { return parameters_; }  ///< column of the right hand side

  /// As it was when built.
  void reset();
  /// A new attitude, expected at psi off the reference, unknown within sigma [rad].
  void cage(const Vec3& psi, double sigma);
  /// psi <- Phi psi + G x, plus white noise Q. G: as wide as whole lanes, or less.
  void propagate(const Mat3& Phi, const Rows3& G, const Mat3& Q);
  /// Adds variance to the walk of walking parameter number k.
  void walk(std::size_t k, double variance) {
    const auto i = static_cast<Eigen::Index>(3 + k);
    P_(i, i) += variance;
  }

  /// Three scalars: innovation nu at the reference (NaN: not measured), H_psi, and rows over
  /// parameters, which begin at a column.
  struct Scalars {
    Vec3 nu;
    const Mat3& H_psi;
    const Rows3* H_rate = nullptr;  ///< from column 0 on; may be null
    const Rows3* H_par = nullptr;   ///< from column `first_par` on; may be null
    std::size_t first_par = 0;
    double sigma = 0.0;  ///< of each scalar's noise
  };
  /// Takes them in; their whitened rows are at rows(), zero where nothing was measured. Leaves out
  /// what lies more than `gate` standard deviations off, as far as `known` knows the parameters
  /// (null: no gate). How many scalars there were; none if their covariance is not positive
  /// definite.
  struct Gate {
    double gate;
    Information* known;
    const VecX* x;  ///< where the parameters are thought to be, from the reference
  };
  std::optional<std::size_t> update(const Scalars& scalars, const Gate* gate, double* rows);

  /// Estimate of the attitude where the parameters are x off the reference [rad].
  Vec3 attitude(const VecX& x) const;
  /// What the walk has added to walking parameter number k, with x; and its variance, x known.
  double walked(std::size_t k, const VecX& x) const { return estimate(3 + k, x); }
  /// Derivatives by x of component i of the attitude, and of that.
  Eigen::Map<const VecX> attitude_by(std::size_t i) const {
    return {row(i), static_cast<Eigen::Index>(parameters_)};
  }
  Eigen::Map<const VecX> walked_by(std::size_t k) const {
    return {row(3 + k), static_cast<Eigen::Index>(parameters_)};
  }
  const Moving& variance() const { return P_; }
  /// From here on, deviations are counted from a reference moved by x, whose attitude is moved to
  /// where it is estimated.
  void move_reference(const VecX& x);

  const std::vector<std::size_t>& walking() const { return walking_; }

 private:
  double* row(std::size_t i) { return U_.data() + i * width_; }
  const double* row(std::size_t i) const { return U_.data() + i * width_; }
  double estimate(std::size_t i, const VecX& x) const;
  std::size_t moving() const { return 3 + walking_.size(); }
  template <int m>
  void propagate_rows(const Moving& F, const Rows3& G);
  template <int m>
  void predict_rows(const Eigen::Matrix<double, 3, 3 + most_walking>& H, double* rows) const;
  template <int m>
  void correct_rows(const Eigen::Matrix<double, 3 + most_walking, 3>& gain, const double* rows);

  std::size_t parameters_, width_;
  std::vector<std::size_t> walking_;
  std::vector<double> U_;  ///< rows of U, of the walking ones too; minus a in column right()
  Moving P_ = Moving::Zero();
};

}  // namespace drift
