#pragma once

#include <numbers>

#include "core/base/pack.hpp"
#include "core/estimate/lanes.hpp"
#include "core/sim/measurements.hpp"

namespace drift {

using PackVec = Vec3T<Pack>;
using PackMat = Mat3T<Pack>;

/// a + b c, fused where the machine has it; lane by lane.
inline Pack mul_add(const Pack& b, const Pack& c, const Pack& a) {
#if defined(__AVX512F__)
  return Pack(Pack::Lanes(_mm512_fmadd_pd(static_cast<__m512d>(b.v), static_cast<__m512d>(c.v),
                                          static_cast<__m512d>(a.v))));
#elif defined(__AVX2__) && defined(__FMA__)
  return Pack(Pack::Lanes(_mm256_fmadd_pd(static_cast<__m256d>(b.v), static_cast<__m256d>(c.v),
                                          static_cast<__m256d>(a.v))));
#else
  return a + b * c;
#endif
}

/// Element i of sum + M v, v three numbers in a row.
inline Pack row_times(const PackMat& M, int i, const Pack* v, const Pack& sum) {
  return mul_add(M(i, 0), v[0], mul_add(M(i, 1), v[1], mul_add(M(i, 2), v[2], sum)));
}
inline PackMat times(const PackMat& A, const PackMat& B) {
  PackMat C;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      C(i, j) = mul_add(A(i, 0), B(0, j), mul_add(A(i, 1), B(1, j), A(i, 2) * B(2, j)));
  return C;
}
inline PackVec times_vector(const PackMat& A, const PackVec& v) {
  PackVec out;
  for (int i = 0; i < 3; ++i) out[i] = row_times(A, i, v.data(), Pack(0.0));
  return out;
}
inline PackMat scaled(double factor, const PackMat& A) {
  PackMat B;
  for (int e = 0; e < 9; ++e) B.data()[e] = Pack(factor) * A.data()[e];
  return B;
}
inline PackMat in_all_lanes(const Mat3& M) {
  PackMat all;
  for (int e = 0; e < 9; ++e) all.data()[e] = Pack(M.data()[e]);
  return all;
}

/// a - b, between -pi and pi [rad].
inline Pack angle_difference(const Pack& a, const Pack& b) {
  const Pack d = a - b;  // what lies between is its own remainder
  return lane_by_lane(d, d, std::experimental::abs(d.v) > std::numbers::pi,
                      [](double one) { return angle_difference(one, 0.0); });
}

/// One lane, and back.
inline Vec3 lane_of(const PackVec& v, int lane) {
  return {v[0][lane], v[1][lane], v[2][lane]};
}
inline void set_lane(PackVec& v, int lane, const Vec3& one) {
  for (int i = 0; i < 3; ++i) v[i].set(lane, one[i]);
}

}  // namespace drift
