#pragma once

#include "core/base/linalg.hpp"

namespace drift {

/// Exponential of a small matrix, off by |a|^4 / 24.
template <class S>
Mat3T<S> small_exponential(const Mat3T<S>& a) {
  const Mat3T<S> I = Mat3T<S>::Identity();
  return I + a * (I + 0.5 * a * (I + a / 3.0));
}

/// Logarithm of the transition matrix of psi' = A psi over a step, to fourth order (Magnus): A
/// turns with the Earth and does not commute with itself. A0, A1: at both ends.
template <class S>
Mat3T<S> magnus(const Mat3T<S>& integral, const Mat3T<S>& A0, const Mat3T<S>& A1, double step) {
  const Mat3T<S> change = step / 12.0 * (A1 - A0);
  return integral + change * integral - integral * change;
}

/// Transition matrices over two steps of `step`, by the parabola of A through three nodes.
template <class S>
struct TwoSteps {
  Mat3T<S> to_middle, to_end;  ///< from the first node
  Mat3T<S> log_of_second;      ///< of the second step alone, its logarithm

  TwoSteps(const Mat3T<S>& A0, const Mat3T<S>& A1, const Mat3T<S>& A2, double step) {
    const Mat3T<S> first = step / 12.0 * (5.0 * A0 + 8.0 * A1 - A2),
                   both = step / 3.0 * (A0 + 4.0 * A1 + A2);
    to_middle = small_exponential<S>(magnus<S>(first, A0, A1, step));
    to_end = small_exponential<S>(magnus<S>(both, A0, A2, 2.0 * step));
    log_of_second = magnus<S>(both - first, A1, A2, step);
  }
};

}  // namespace drift
