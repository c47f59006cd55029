#pragma once

#include "core/base/linalg.hpp"

namespace drift {

/// Exponential of a small matrix, off by |a|^4 / 24.
inline Mat3 small_exponential(const Mat3& a) {
  const Mat3 I = Mat3::Identity();
  return I + a * (I + 0.5 * a * (I + a / 3.0));
}

/// Logarithm of the transition matrix of psi' = A psi over a step, to fourth order (Magnus): A
/// turns with the Earth and does not commute with itself. A0, A1: at both ends.
inline Mat3 magnus(const Mat3& integral, const Mat3& A0, const Mat3& A1, double step) {
  const Mat3 change = step / 12.0 * (A1 - A0);
  return integral + change * integral - integral * change;
}

}  // namespace drift
