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

/// Transition matrices over two steps of `step`, by the parabola of A through three nodes.
struct TwoSteps {
  Mat3 to_middle, to_end;  ///< from the first node
  Mat3 log_of_second;      ///< of the second step alone, its logarithm

  TwoSteps(const Mat3& A0, const Mat3& A1, const Mat3& A2, double step) {
    const Mat3 first = step / 12.0 * (5.0 * A0 + 8.0 * A1 - A2),
               both = step / 3.0 * (A0 + 4.0 * A1 + A2);
    to_middle = small_exponential(magnus(first, A0, A1, step));
    to_end = small_exponential(magnus(both, A0, A2, 2.0 * step));
    log_of_second = magnus(both - first, A1, A2, step);
  }
};

}  // namespace drift
