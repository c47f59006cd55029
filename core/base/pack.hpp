#pragma once

#include <cmath>
#include <experimental/simd>

#include "core/base/dual.hpp"
#include "core/base/linalg.hpp"

namespace drift {

/// Several doubles, as many as the machine handles at once: the scalar type of physics worked out
/// for several instants in lock step. Arithmetic is element by element, so what comes out of a lane
/// does not depend on its neighbours; functions beyond arithmetic and square roots are the plain
/// ones, lane after lane.
///
/// It cannot be compared and has no value(): a term that decides by a number does not compile with
/// it (see in_lanes in slot_derivatives.hpp).
struct Pack {
  using Lanes = std::experimental::native_simd<double>;
  static constexpr int width = static_cast<int>(Lanes::size());
  Lanes v;

  Pack() = default;
  Pack(double all) : v(all) {}  // NOLINT(google-explicit-constructor): a number is a constant
  explicit Pack(const Lanes& lanes) : v(lanes) {}

  double operator[](int lane) const { return v[static_cast<std::size_t>(lane)]; }
  void set(int lane, double value) { v[static_cast<std::size_t>(lane)] = value; }
  /// The lanes in a row.
  void store(double* to) const { v.copy_to(to, std::experimental::element_aligned); }
  static Pack load(const double* from) {
    return Pack(Lanes(from, std::experimental::element_aligned));
  }
  /// of(lane) in every lane.
  template <class Of>
  static Pack of_each(Of&& of) {
    double lane[width];
    for (int l = 0; l < width; ++l) lane[l] = of(l);
    return load(lane);
  }

  Pack& operator+=(const Pack& o) { return v += o.v, *this; }
  Pack& operator-=(const Pack& o) { return v -= o.v, *this; }
  Pack& operator*=(const Pack& o) { return v *= o.v, *this; }
  Pack& operator/=(const Pack& o) { return v /= o.v, *this; }
  friend Pack operator+(const Pack& a, const Pack& b) { return Pack(a.v + b.v); }
  friend Pack operator-(const Pack& a, const Pack& b) { return Pack(a.v - b.v); }
  friend Pack operator*(const Pack& a, const Pack& b) { return Pack(a.v * b.v); }
  friend Pack operator/(const Pack& a, const Pack& b) { return Pack(a.v / b.v); }
  friend Pack operator-(const Pack& a) { return Pack(-a.v); }
};

inline Pack sqrt(const Pack& a) {
  return Pack(std::experimental::sqrt(a.v));
}
inline Pack abs(const Pack& a) {
  return Pack(std::experimental::abs(a.v));
}
inline Pack copysign(const Pack& size, const Pack& sign) {
  return Pack(std::experimental::copysign(size.v, sign.v));
}
inline Pack at_least(const Pack& a, double least) {
  return Pack(std::experimental::max(a.v, Pack::Lanes(least)));
}
template <int N>
Dual<N, Pack> at_least(const Dual<N, Pack>& a, double least) {
  Dual<N, Pack> out(at_least(a.v, least));
  // Not by where(): what libstdc++ 12 makes of it for AVX-512 assigns nothing when clang compiles
  // it.
  for (int k = 0; k < N; ++k)
    out.d[k] = Pack::of_each([&](int l) { return a.v[l] > least ? a.d[k][l] : 0.0; });
  return out;
}
#define DRIFT_LANE_BY_LANE(f)                                  \
  inline Pack f(const Pack& a) {                               \
    return Pack::of_each([&](int l) { return std::f(a[l]); }); \
  }
DRIFT_LANE_BY_LANE(sin)
DRIFT_LANE_BY_LANE(cos)
DRIFT_LANE_BY_LANE(exp)
DRIFT_LANE_BY_LANE(tanh)
DRIFT_LANE_BY_LANE(asin)
#undef DRIFT_LANE_BY_LANE
inline Pack atan2(const Pack& y, const Pack& x) {
  return Pack::of_each([&](int l) { return std::atan2(y[l], x[l]); });
}

/// `usual` with the lanes of a mask replaced by of(x), each as it would be alone.
template <class Mask, class Of>
Pack lane_by_lane(const Pack& x, Pack usual, const Mask& others, Of&& of) {
  if (std::experimental::none_of(others)) return usual;
  for (int l = 0; l < Pack::width; ++l)
    if (others[static_cast<std::size_t>(l)]) usual.set(l, of(x[l]));
  return usual;
}

/// rotation(v) lane by lane where some angle is too large for the series, which serves all others:
/// every lane gets what it would get alone.
template <>
inline RotationCoefficients<Pack> rotation_coefficients(const Pack& t2) {
  const auto series = rotation_series(t2);
  const auto large = t2.v >= rotation_series_until;
  return {lane_by_lane(t2, series.a, large, [](double x) { return rotation_coefficients(x).a; }),
          lane_by_lane(t2, series.b, large, [](double x) { return rotation_coefficients(x).b; })};
}

}  // namespace drift

template <>
struct Eigen::NumTraits<drift::Pack> : Eigen::NumTraits<double> {
  using Real = drift::Pack;
  using NonInteger = drift::Pack;
  using Nested = drift::Pack;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 0,
    ReadCost = 1,
    AddCost = 1,
    MulCost = 1
  };
};
template <class Op>
struct Eigen::ScalarBinaryOpTraits<drift::Pack, double, Op> {
  using ReturnType = drift::Pack;
};
template <class Op>
struct Eigen::ScalarBinaryOpTraits<double, drift::Pack, Op> {
  using ReturnType = drift::Pack;
};
