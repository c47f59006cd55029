#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace drift::stats {

/// The five noises of IEEE Std 952: quantisation Q, random walk N (white rate), flicker B, rate
/// random walk K, and a ramp R.
enum class AllanNoise { quantisation, white, flicker, rate_walk, ramp };
inline constexpr int allan_noises = 5;

/// Squares of the five coefficients, with time counted in samples.
using AllanSquares = Eigen::Matrix<double, allan_noises, 1>;

/// Allan variance of each noise at an averaging time, for a coefficient of one:
/// 3 / tau^2, 1 / tau, (2 ln 2) / pi, tau / 3, tau^2 / 2.
AllanSquares allan_slopes(double tau);

/// Covariance of overlapping Allan variances, for Gaussian noise of the five kinds, from its
/// definition.
///
/// An Allan variance is the mean of z(k)^2, z(k) a second difference of the integrated rate, whose
/// covariance follows from the generalised covariance of that integral: for lag t
///
///   Q^2 delta(t),   -N^2 |t| / 2,   B^2 t^2 ln|t| / (2 pi),   K^2 |t|^3 / 12;
///
/// constants, lines and parabolas that these leave open cancel in second differences. With
/// cov(z1^2, z2^2) = 2 cov(z1, z2)^2 + 4 mean(z1) mean(z2) cov(z1, z2), the means those of the
/// ramp, the covariance of two variances is a double sum over the places of both in each stretch.
/// It is quadratic in the squares of the coefficients: the sums are taken once.
class AllanCovariance {
 public:
  enum class Pairs { all, diagonal };  ///< of variances

  /// lengths: of the stretches that the variances are pooled over.
  AllanCovariance(std::span<const std::size_t> lengths, std::span<const std::size_t> counts,
                  Pairs pairs = Pairs::all);

  /// For these squares of the coefficients.
  Eigen::MatrixXd of(const AllanSquares& squares) const;

 private:
  static constexpr int random = 4;  ///< kinds of noise without the ramp
  Eigen::Index size_ = 0;
  std::array<std::array<Eigen::MatrixXd, random>, random> products_;  ///< of two kinds, a <= b
  std::array<Eigen::MatrixXd, random> with_ramp_;

  void add_pair(std::span<const std::size_t> lengths, std::span<const std::size_t> counts,
                Eigen::Index i, Eigen::Index j);
};

}  // namespace drift::stats
