#include "core/estimate/strapdown/gyrocompass.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/decompose.hpp"

namespace drift::strapdown {

namespace {

/// Normal equations of what the gyros read at rest: the Earth's horizontal rate of each chain (two
/// numbers), the drift of three gyros, the Earth's rate about Up.
struct Rests {
  MatX N;
  VecX right;
  double squares = 0.0;  ///< of what was read, weighted
  double readings = 0.0;
  Eigen::Index up() const { return N.rows() - 1; }

  /// With the rate about Up as given [rad/s].
  struct Solution {
    VecX x;
    MatX P;
  };
  Solution solved(double rate_up) const {
    const Cholesky llt(N.topLeftCorner(up(), up()));
    return {llt.solve(VecX(right.head(up()) - N.col(up()).head(up()) * rate_up)),
            llt.solve(MatX(MatX::Identity(up(), up())))};
  }
  /// Chi-square per degree of freedom of what is left, and 1 at least: gyros that read at rest what
  /// is neither the Earth nor a fixed drift (g-sensitivity, a drift that walks) tell of the Earth
  /// less than their noise says.
  double misfit(const Solution& found, double rate_up) const {
    VecX all(N.rows());
    all << found.x, rate_up;
    const double chi2 = squares - 2.0 * all.dot(right) + all.dot(N * all),
                 dof = readings + 3.0 - static_cast<double>(up());  // three priors of the drift
    return dof > 0.0 ? std::max(1.0, chi2 / dof) : 1.0;
  }
};

Rests rests_of(const CaseTest& test, double sigma_drift) {
  const auto chains = static_cast<Eigen::Index>(test.timeline.chains);
  const Eigen::Index n = 2 * chains + 4;
  Rests sums{MatX::Zero(n, n), VecX::Zero(n)};
  sums.N.diagonal().segment<3>(2 * chains).setConstant(1.0 / (sigma_drift * sigma_drift));
  const double weight = 1.0 / (test.readout.gimbal_noise * test.readout.gimbal_noise);
  for (const Interval& i : test.timeline.intervals) {
    if (!i.rest) continue;
    const Mat3 R_pl = test.timeline.nodes[i.middle_node()].R_lr.transpose();
    MatX J = MatX::Zero(3, n);
    J.middleCols<2>(2 * i.chain) = R_pl.leftCols<2>();
    J.middleCols<3>(2 * chains).setIdentity();
    J.col(sums.up()) = R_pl.col(2);
    sums.N += weight * J.transpose() * J;
    sums.right += weight * J.transpose() * i.omega_cmd_p;
    sums.squares += weight * i.omega_cmd_p.squaredNorm();
    sums.readings += 3.0;
  }
  return sums;
}

/// North as the gyros have it, against the North that was assumed [rad].
double azimuth_of(const Eigen::Vector2d& north, const std::vector<double>& assumed,
                  Eigen::Index chain) {
  const auto c = static_cast<std::size_t>(chain);
  return (c < assumed.size() ? assumed[c] : 0.0) - std::atan2(north[1], north[0]);
}

/// Whether the prior of the drift moves the North of a chain by more than three standard deviations
/// of it, and by more than it may if it is right (a chance of 1e-6): two solutions, of which one
/// has more information, differ by the difference of their covariances (Hausman 1978). A drift a
/// thousand times its prior's sigma would be left to the Earth to explain.
bool prior_moves_north(const Rests::Solution& with, const Rests::Solution& without,
                       Eigen::Index chain) {
  constexpr double chance = 1e-6;
  const Eigen::Vector2d moved = with.x.segment<2>(2 * chain) - without.x.segment<2>(2 * chain);
  const Eigen::Matrix2d P = with.P.block<2, 2>(2 * chain, 2 * chain);
  if (moved.squaredNorm() <= 9.0 * P.trace() / 2.0) return false;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> apart(
      without.P.block<2, 2>(2 * chain, 2 * chain) - P);
  const Eigen::Vector2d along = apart.eigenvectors().transpose() * moved;
  double chi2 = 0.0;
  for (int k = 0; k < 2; ++k)
    if (apart.eigenvalues()[k] > 1e-9 * P.trace())
      chi2 += along[k] * along[k] / apart.eigenvalues()[k];
  return chi2 > -2.0 * std::log(chance);
}

}  // namespace

AxisHeading axis_heading(const Vec3& acc, double azimuth) {
  const Mat3 R_lc = levelled(acc, azimuth);
  AxisHeading out;
  while (std::abs(R_lc(2, out.axis)) > std::sqrt(0.5)) ++out.axis;  // one of them at most
  const double to_west = std::atan2(R_lc(1, out.axis), R_lc(0, out.axis));
  constexpr double whole = 2.0 * std::numbers::pi;
  out.azimuth = std::fmod(whole - to_west, whole);
  return out;
}

Gyrocompass gyrocompass(const CaseTest& test, const std::vector<double>& assumed_azimuth,
                        double sigma_drift) {
  const Timeline& timeline = test.timeline;
  const Vec3 omega_ie_l = timeline.site.omega_ie_l();
  const double horizontal = omega_ie_l.head<2>().norm();
  constexpr double none = 1000.0;  // times wider a prior says nothing, and equations stay sound
  const Rests rests = rests_of(test, sigma_drift);
  const Rests::Solution found = rests.solved(omega_ie_l[2]),
                        without_prior = rests_of(test, none * sigma_drift).solved(omega_ie_l[2]);
  const double misfit = rests.misfit(found, omega_ie_l[2]);
  Gyrocompass out;
  out.sees_earth = horizontal > 0.0;
  out.sigma = 0.0;
  for (Eigen::Index c = 0; c < timeline.chains; ++c) {
    const Eigen::Vector2d north = found.x.segment<2>(2 * c);
    const double sigma = std::sqrt(misfit * found.P.block<2, 2>(2 * c, 2 * c).trace() / 2.0);
    out.azimuth.push_back(azimuth_of(north, assumed_azimuth, c));
    out.sigma = std::max(out.sigma, sigma / horizontal);
    if (std::abs(north.norm() - horizontal) > 3.0 * sigma + 0.1 * horizontal ||
        prior_moves_north(found, without_prior, c))
      out.sees_earth = false;
  }
  if (out.sigma > 0.3) out.sees_earth = false;
  if (!out.sees_earth) out.sigma = 1.0;
  return out;
}

EarthSeen earth_seen(const CaseTest& test, const std::vector<double>& assumed_azimuth,
                     double sigma_drift) {
  Rests sums = rests_of(test, sigma_drift);
  constexpr double beyond_the_earth = 10.0 * detail::earth_rate;  // it is no faster than that
  sums.N(sums.up(), sums.up()) += 1.0 / (beyond_the_earth * beyond_the_earth);
  const Cholesky llt(sums.N);
  const VecX x = llt.solve(sums.right);
  const MatX P = llt.solve(MatX(MatX::Identity(sums.N.rows(), sums.N.rows())));
  EarthSeen out;
  double weights = 0.0, horizontal = 0.0;
  for (Eigen::Index c = 0; c < test.timeline.chains; ++c) {
    const Eigen::Vector2d north = x.segment<2>(2 * c);
    const double weight = 2.0 / P.block<2, 2>(2 * c, 2 * c).trace();
    out.azimuth.push_back(azimuth_of(north, assumed_azimuth, c));
    horizontal += weight * north.norm();
    weights += weight;
  }
  horizontal /= weights;
  const double up = x[sums.up()], variance = 1.0 / weights, variance_up = P(sums.up(), sums.up());
  const double square = up * up + horizontal * horizontal;
  out.latitude = std::atan2(up, horizontal);
  out.rate = std::sqrt(square);
  out.sigma = std::sqrt(up * up * variance + horizontal * horizontal * variance_up) / square;
  out.sigma_rate = std::sqrt((horizontal * horizontal * variance + up * up * variance_up) / square);
  return out;
}

}  // namespace drift::strapdown
