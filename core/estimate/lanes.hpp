#pragma once

#include <cstddef>
#if defined(__AVX512F__) || (defined(__AVX2__) && defined(__FMA__))
#include <immintrin.h>
#endif

namespace drift {

/// As many doubles as the machine handles at once: products of tall narrow matrices are worked out
/// with whole rows of them in registers. mul_add(b, c, a) = a + b c, fused where the machine has
/// it; so results are the same bits for a given instruction set.
#if defined(__AVX512F__)
using Lanes = __m512d;
inline Lanes load(const double* p) {
  return _mm512_loadu_pd(p);
}
inline void store(double* p, Lanes a) {
  _mm512_storeu_pd(p, a);
}
inline Lanes broadcast(double a) {
  return _mm512_set1_pd(a);
}
inline Lanes mul_add(Lanes b, Lanes c, Lanes a) {
  return _mm512_fmadd_pd(b, c, a);
}
inline constexpr int lanes_at_once = 8;  ///< of 32 registers, 3 of these sets fit
#elif defined(__AVX2__) && defined(__FMA__)
using Lanes = __m256d;
inline Lanes load(const double* p) {
  return _mm256_loadu_pd(p);
}
inline void store(double* p, Lanes a) {
  _mm256_storeu_pd(p, a);
}
inline Lanes broadcast(double a) {
  return _mm256_set1_pd(a);
}
inline Lanes mul_add(Lanes b, Lanes c, Lanes a) {
  return _mm256_fmadd_pd(b, c, a);
}
inline constexpr int lanes_at_once = 4;  ///< of 16 registers
#else
struct Lanes {
  double a, b;
};
inline Lanes load(const double* p) {
  return {p[0], p[1]};
}
inline void store(double* p, Lanes a) {
  p[0] = a.a;
  p[1] = a.b;
}
inline Lanes broadcast(double a) {
  return {a, a};
}
inline Lanes mul_add(Lanes b, Lanes c, Lanes a) {
  return {a.a + b.a * c.a, a.b + b.b * c.b};
}
inline constexpr int lanes_at_once = 2;
#endif

inline constexpr std::size_t lane_width = sizeof(Lanes) / sizeof(double);

/// n rounded up to whole lanes.
constexpr std::size_t whole_lanes(std::size_t n) {
  return (n + lane_width - 1) / lane_width * lane_width;
}

/// Calls body.template operator()<count>(row): blocks of `most` lanes, then the rest singly.
/// rows must be whole lanes.
template <int most = lanes_at_once, class Body>
void for_lanes(std::size_t rows, Body&& body) {
  std::size_t row = 0;
  for (; row + most * lane_width <= rows; row += most * lane_width)
    body.template operator()<most>(row);
  for (; row < rows; row += lane_width) body.template operator()<1>(row);
}

}  // namespace drift
