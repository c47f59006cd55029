#pragma once

#include "core/estimate/sequential/in_lanes/lane_math.hpp"

namespace drift {

/// Tiles of 4 x 4 numbers of several runs, one in each lane: what fits the registers.

/// tile += or -= x y^T, four numbers x and y.
enum class Sign { plus, minus };
template <Sign sign>
[[gnu::always_inline]] inline void add_product(const Pack* x, const Pack* y, Pack (&tile)[16]) {
  const Pack y0 = y[0], y1 = y[1], y2 = y[2], y3 = y[3];
#pragma GCC unroll 4
  for (int i = 0; i < 4; ++i) {
    const Pack xi = sign == Sign::plus ? x[i] : -x[i];
    tile[4 * i] = mul_add(xi, y0, tile[4 * i]);
    tile[4 * i + 1] = mul_add(xi, y1, tile[4 * i + 1]);
    tile[4 * i + 2] = mul_add(xi, y2, tile[4 * i + 2]);
    tile[4 * i + 3] = mul_add(xi, y3, tile[4 * i + 3]);
  }
}
[[gnu::always_inline]] inline void load_tile(const Pack* from, Pack (&tile)[16]) {
#pragma GCC unroll 16
  for (int e = 0; e < 16; ++e) tile[e] = from[e];
}
[[gnu::always_inline]] inline void store_tile(const Pack (&tile)[16], Pack* to) {
#pragma GCC unroll 16
  for (int e = 0; e < 16; ++e) to[e] = tile[e];
}

/// L^-1 of S = L L^T of which the lower triangle is given (small_cholesky.hpp); not a number in a
/// lane in which S is not positive.
struct InverseRoot {
  Pack i0, i1, i2, m10, m20, m21;

  explicit InverseRoot(const PackMat& S) {
    const Pack one(1.0);
    i0 = one / sqrt(S(0, 0));
    const Pack l10 = S(1, 0) * i0, l20 = S(2, 0) * i0;
    i1 = one / sqrt(S(1, 1) - l10 * l10);
    const Pack l21 = (S(2, 1) - l20 * l10) * i1;
    i2 = one / sqrt(S(2, 2) - l20 * l20 - l21 * l21);
    m10 = -(i1 * l10 * i0);
    m21 = -(i2 * l21 * i1);
    m20 = -(i2 * (l20 * i0 + l21 * m10));
  }
  /// L^-1 v; for a row r of numbers it is r L^-T.
  PackVec times(const PackVec& v) const {
    return {i0 * v[0], mul_add(m10, v[0], i1 * v[1]),
            mul_add(m20, v[0], mul_add(m21, v[1], i2 * v[2]))};
  }
};

}  // namespace drift
