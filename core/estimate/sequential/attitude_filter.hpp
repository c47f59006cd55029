#pragma once

#include <optional>
#include <vector>

#include "core/estimate/rows3.hpp"
#include "core/estimate/sequential/information.hpp"

namespace drift {

/// A Kalman filter of what moves, whose innovations are linear in what stands still.
///
/// States: 3 attitude errors and, where drift walks, as many further ones, what the walk has added
/// to some parameters; then 3 of the gyros' noise in a sample, where there is any (HeldNoise).
/// Their estimate hangs on the static parameters x (deviations from a
/// reference), z = a + U x, and gains depend on the noise alone; so every measurement gives
/// whitened rows [t | e] of a static least squares problem, |t x - e|^2, process noise and new
/// attitudes at cagings included (Friedland, IEEE TAC 14(4), 1969). Columns are the parameters,
/// then the right hand side, then zeros up to whole lanes.
class AttitudeFilter {
 public:
  static constexpr int most_walking = 3, most_moving = 6 + most_walking;
  using Moving = Eigen::Matrix<double, most_moving, most_moving>;

  /// walking: parameters whose value walks, at most three, none of them twice. holds: whether there
  /// is noise that is held.
  AttitudeFilter(std::size_t parameters, std::vector<std::size_t> walking, bool holds);

  std::size_t width() const { return width_; }       ///< of a row, whole lanes
  std::size_t right() const { return parameters_; }  ///< column of the right hand side

  /// As it was when built.
  void reset();
  /// A new attitude, expected at psi off the reference, unknown within sigma [rad].
  void cage(const Vec3& psi, double sigma);
  /// The noise n of another sample, of that variance in each axis, independent of all before.
  void hold(double variance);
  /// psi <- Phi psi + G x + N n. G: as wide as whole lanes, or less.
  void propagate(const Mat3& Phi, const Rows3& G, const Mat3& N);
  /// The attitude gains a covariance that nothing before it feels [rad^2].
  void disturb(const Mat3& covariance) { P_.topLeftCorner<3, 3>() += covariance; }
  /// Adds variance to the walk of walking parameter number k.
  void walk(std::size_t k, double variance) {
    const auto i = static_cast<Eigen::Index>(3 + k);
    P_(i, i) += variance;
  }
  /// That walk begins anew, at zero but for a variance.
  void walk_anew(std::size_t k, double variance);

  /// Three scalars: innovation nu at the reference (NaN: not measured), H_psi, and rows over
  /// parameters, which begin at a column.
  struct Scalars {
    Vec3 nu;
    const Mat3& H_psi;
    const Rows3* H_rate = nullptr;  ///< from column 0 on; may be null
    const Rows3* H_par = nullptr;   ///< from column `first_par` on; may be null
    std::size_t first_par = 0;
    double sigma = 0.0;            ///< of each scalar's noise
    const Mat3* H_held = nullptr;  ///< by the noise that is held, null where it does not act
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
  /// Derivatives of that by x.
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
  using Measuring = Eigen::Matrix<double, 3, most_moving>;
  using Gain = Eigen::Matrix<double, most_moving, 3>;
  /// Calls body.operator()<m>() with the number of states, or more: unused ones are zero.
  template <class Body>
  decltype(auto) with_states(Body&& body) const;
  template <int m>
  void propagate_rows(const Moving& F, const Rows3& G);
  template <int m>
  void predict_rows(const Measuring& H, double* rows) const;
  template <int m>
  void correct_rows(const Gain& gain, const double* rows);

  static constexpr std::size_t first_held = 3 + most_walking;
  std::size_t parameters_, width_;
  std::vector<std::size_t> walking_;
  bool holds_;
  std::vector<double> U_;  ///< rows of U, of the walking ones too; minus a in column right()
  Moving P_ = Moving::Zero();
};

}  // namespace drift
