#pragma once

#include <cmath>

#include "core/base/dual.hpp"
#include "core/base/linalg.hpp"

namespace drift {

/// Resolver angles (outer, middle, inner) [rad] of the chain v_c = Rx(outer) Ry(middle) Rz(inner) v_p.
/// Singular at middle = +-90 deg: only the readout uses it, never the dynamics.
template <class S>
Vec3T<S> gimbal_angles(const Mat3T<S>& R_cp) {
  using std::asin;
  using std::atan2;
  return {atan2(-R_cp(1, 2), R_cp(2, 2)), asin(R_cp(0, 2)), atan2(-R_cp(0, 1), R_cp(0, 0))};
}

/// The chain's rotation for given angles; inverse of gimbal_angles.
inline Mat3 gimbal_chain(const Vec3& angles) {
  return rotation(Vec3(angles[0], 0, 0)) * rotation(Vec3(0, angles[1], 0)) *
         rotation(Vec3(0, 0, angles[2]));
}

}  // namespace drift
