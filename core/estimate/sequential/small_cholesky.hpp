#pragma once

#include <cmath>

#include "core/base/linalg.hpp"

namespace drift {

/// L^-1 of S = L L^T. False unless S is positive definite (a NaN is not).
inline bool inverse_cholesky(const Mat3& S, Mat3& L_inv) {
  const double d0 = S(0, 0);
  if (!(d0 > 0.0)) return false;
  const double i0 = 1.0 / std::sqrt(d0), l10 = S(1, 0) * i0, l20 = S(2, 0) * i0;
  const double d1 = S(1, 1) - l10 * l10;
  if (!(d1 > 0.0)) return false;
  const double i1 = 1.0 / std::sqrt(d1), l21 = (S(2, 1) - l20 * l10) * i1;
  const double d2 = S(2, 2) - l20 * l20 - l21 * l21;
  if (!(d2 > 0.0)) return false;
  const double i2 = 1.0 / std::sqrt(d2);
  const double m10 = -i1 * l10 * i0, m21 = -i2 * l21 * i1;
  L_inv << i0, 0.0, 0.0, m10, i1, 0.0, -i2 * (l20 * i0 + l21 * m10), m21, i2;
  return std::isfinite(i0 + i1 + i2);
}

}  // namespace drift
