#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace drift {

template <class S>
using Vec3T = Eigen::Matrix<S, 3, 1>;
template <class S>
using Mat3T = Eigen::Matrix<S, 3, 3>;
using Vec3 = Vec3T<double>;
using Mat3 = Mat3T<double>;
using VecX = Eigen::VectorXd;
using MatX = Eigen::MatrixXd;

/// Three consecutive numbers as a vector.
template <class S>
Vec3T<S> vec3(const S* p) {
  return {p[0], p[1], p[2]};
}

/// [v x], the matrix with skew(v) w = v x w.
template <class S>
Mat3T<S> skew(const Vec3T<S>& v) {
  Mat3T<S> m;
  m << S(0), -v[2], v[1], v[2], S(0), -v[0], -v[1], v[0], S(0);
  return m;
}

/// Of Rodrigues' formula, for the square of an angle t: sin(t)/t and (1 - cos t)/t^2.
template <class S>
struct RotationCoefficients {
  S a, b;
};
/// Where the series end, 1 rad: their remainders, t^18/19! and t^18/20!, are below 1e-17.
inline constexpr double rotation_series_until = 1.0;
template <class S>
RotationCoefficients<S> rotation_series(const S& t2) {
  // Odd and even powers of t2 side by side: half as long a chain of sums.
  const S t4 = t2 * t2;
  const auto sum = [&](const double(&even)[5], const double(&odd)[4]) {
    S e(even[4]), o(odd[3]);
    for (int k = 3; k >= 0; --k) e = e * t4 + even[k];
    for (int k = 2; k >= 0; --k) o = o * t4 + odd[k];
    return S(e + o * t2);
  };
  return {sum({1.0, 1.0 / 120.0, 1.0 / 362880.0, 1.0 / 6227020800.0, 1.0 / 355687428096000.0},
              {-1.0 / 6.0, -1.0 / 5040.0, -1.0 / 39916800.0, -1.0 / 1307674368000.0}),
          sum({0.5, 1.0 / 720.0, 1.0 / 3628800.0, 1.0 / 87178291200.0, 1.0 / 6402373705728000.0},
              {-1.0 / 24.0, -1.0 / 40320.0, -1.0 / 479001600.0, -1.0 / 20922789888000.0})};
}
template <class S>
RotationCoefficients<S> rotation_coefficients(const S& t2) {
  using std::cos;
  using std::sin;
  using std::sqrt;
  if (t2 < rotation_series_until) return rotation_series(t2);
  const S t = sqrt(t2);
  return {sin(t) / t, (S(1) - cos(t)) / t2};
}

/// Rotation matrix of the rotation vector v [rad]: exp([v x]), Rodrigues' formula, by series below
/// 1 rad.
template <class S>
Mat3T<S> rotation(const Vec3T<S>& v) {
  const auto [a, b] = rotation_coefficients<S>(v.squaredNorm());
  const Mat3T<S> k = skew(v);
  return Mat3T<S>::Identity() + a * k + b * (k * k).eval();
}

/// Rotation vector of a rotation matrix [rad], length in [0, pi].
inline Vec3 rotation_vector(const Mat3& r) {
  const Eigen::Quaterniond q(r);
  const double n = q.vec().norm();
  if (n < 1e-12) return 2.0 * q.vec() / (q.w() < 0 ? -1.0 : 1.0);
  return 2.0 * std::atan2(q.w() < 0 ? -n : n, std::abs(q.w())) / n * q.vec();
}

}  // namespace drift
