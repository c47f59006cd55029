#pragma once

#include "core/base/linalg.hpp"

namespace drift {

/// R_cp of the chain v_c = Rx(outer) Ry(middle) Rz(inner) v_p for given angles [rad]; inverse of
/// gimbal_angles().
inline Mat3 gimbal_chain(const Vec3& angles) {
  return rotation(Vec3(angles[0], 0, 0)) * rotation(Vec3(0, angles[1], 0)) *
         rotation(Vec3(0, 0, angles[2]));
}

}  // namespace drift
