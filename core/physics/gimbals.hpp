#pragma once

#include <cmath>

#include "core/base/dual.hpp"
#include "core/base/linalg.hpp"
#include "core/recording/gimbal_chain.hpp"

namespace drift {

/// Resolver angles (outer, middle, inner) [rad] of the chain v_c = Rx(outer) Ry(middle) Rz(inner)
/// v_p. Singular at middle = +-90 deg: only the readout uses it, never the dynamics.
template <class S>
Vec3T<S> gimbal_angles(const Mat3T<S>& R_cp) {
  using std::asin;
  using std::atan2;
  return {atan2(-R_cp(1, 2), R_cp(2, 2)), asin(R_cp(0, 2)), atan2(-R_cp(0, 1), R_cp(0, 0))};
}

/// Derivatives of gimbal_angles by a small rotation of the platform, case axes: R_cp -> exp([d x])
/// R_cp, shape (3, 3).
template <class S>
Mat3T<S> gimbal_angles_by_rotation(const Mat3T<S>& R_cp) {
  using std::sqrt;
  // Of a row of R_cp, the rotation adds another: row 0 gains d_y row 2 - d_z row 1, and so on.
  const Vec3T<S> last = R_cp.col(2);
  const S n = last[1] * last[1] + last[2] * last[2];
  const S m = R_cp(0, 0) * R_cp(0, 0) + R_cp(0, 1) * R_cp(0, 1);
  const S cos_middle = sqrt(S(1.0) - last[0] * last[0]);
  const auto across = [&](int row) {
    return S((R_cp(0, 1) * R_cp(row, 0) - R_cp(0, 0) * R_cp(row, 1)) / m);
  };
  Mat3T<S> J;
  J << S(1.0), -last[0] * last[1] / n, -last[0] * last[2] / n,  //
      S(0.0), last[2] / cos_middle, -last[1] / cos_middle,      //
      S(0.0), across(2), -across(1);
  return J;
}

/// Directions of the gimbal axes outer, middle, inner (columns), platform axes, shape (3, 3).
template <class S>
Mat3T<S> gimbal_axes(const Vec3T<S>& angles) {
  using std::cos;
  using std::sin;
  const S cm = cos(angles[1]), sm = sin(angles[1]), ci = cos(angles[2]), si = sin(angles[2]);
  Mat3T<S> axes;
  axes << cm * ci, si, S(0.0),  //
      -cm * si, ci, S(0.0),     //
      sm, S(0.0), S(1.0);
  return axes;
}

/// Rates of the gimbal angles [rad/s] while the platform turns at omega_cp_p against its case.
template <class S>
Vec3T<S> gimbal_rates(const Vec3T<S>& angles, const Vec3T<S>& omega_cp_p) {
  using std::cos;
  using std::sin;
  const S ci = cos(angles[2]), si = sin(angles[2]);
  const S outer = (ci * omega_cp_p[0] - si * omega_cp_p[1]) / cos(angles[1]);
  return {outer, si * omega_cp_p[0] + ci * omega_cp_p[1], omega_cp_p[2] - outer * sin(angles[1])};
}

/// Index of the gimbal that a discrete parameter 1, 2, 3 names.
template <class S>
int gimbal_number(const S& parameter) {
  const double number = value(parameter);
  return number < 1.5 ? 0 : number < 2.5 ? 1 : 2;
}

}  // namespace drift
