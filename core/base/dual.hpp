#pragma once

#include <Eigen/Core>
#include <cmath>

namespace drift {

/// A value with N partial derivatives (forward differentiation), so that physics is written once
/// for value and Jacobian.
template <int N>
struct Dual {
  double v = 0.0;
  Eigen::Array<double, N, 1> d = Eigen::Array<double, N, 1>::Zero();

  Dual() = default;
  Dual(double value) : v(value) {}  // NOLINT(google-explicit-constructor): a number is a constant
  Dual(double value, const Eigen::Array<double, N, 1>& derivative) : v(value), d(derivative) {}
  /// The variable number i.
  static Dual variable(double value, int i) {
    Dual x(value);
    x.d[i] = 1.0;
    return x;
  }

  Dual& operator+=(const Dual& o) {
    v += o.v;
    d += o.d;
    return *this;
  }
  Dual& operator-=(const Dual& o) {
    v -= o.v;
    d -= o.d;
    return *this;
  }
  Dual& operator*=(const Dual& o) {
    d = d * o.v + v * o.d;
    v *= o.v;
    return *this;
  }
  Dual& operator/=(const Dual& o) {
    v /= o.v;
    d = (d - v * o.d) / o.v;
    return *this;
  }
  friend Dual operator+(Dual a, const Dual& b) { return a += b; }
  friend Dual operator-(Dual a, const Dual& b) { return a -= b; }
  friend Dual operator*(Dual a, const Dual& b) { return a *= b; }
  friend Dual operator/(Dual a, const Dual& b) { return a /= b; }
  friend Dual operator-(const Dual& a) { return {-a.v, -a.d}; }
  friend bool operator<(const Dual& a, const Dual& b) { return a.v < b.v; }
  friend bool operator>(const Dual& a, const Dual& b) { return a.v > b.v; }
  friend bool operator<=(const Dual& a, const Dual& b) { return a.v <= b.v; }
  friend bool operator>=(const Dual& a, const Dual& b) { return a.v >= b.v; }
  friend bool operator==(const Dual& a, const Dual& b) { return a.v == b.v; }
  friend bool operator!=(const Dual& a, const Dual& b) { return a.v != b.v; }
};

template <int N>
Dual<N> sin(const Dual<N>& x) {
  return {std::sin(x.v), std::cos(x.v) * x.d};
}
template <int N>
Dual<N> cos(const Dual<N>& x) {
  return {std::cos(x.v), -std::sin(x.v) * x.d};
}
template <int N>
Dual<N> exp(const Dual<N>& x) {
  return {std::exp(x.v), std::exp(x.v) * x.d};
}
template <int N>
Dual<N> abs(const Dual<N>& x) {
  return x.v < 0 ? -x : x;
}
template <int N>
Dual<N> sqrt(const Dual<N>& x) {
  const double r = std::sqrt(x.v);
  return {r, x.d * (0.5 / r)};
}
template <int N>
Dual<N> tanh(const Dual<N>& x) {
  const double t = std::tanh(x.v);
  return {t, (1.0 - t * t) * x.d};
}
template <int N>
Dual<N> atan2(const Dual<N>& y, const Dual<N>& x) {
  const double n = x.v * x.v + y.v * y.v;
  return {std::atan2(y.v, x.v), (x.v * y.d - y.v * x.d) / n};
}
template <int N>
Dual<N> asin(const Dual<N>& x) {
  return {std::asin(x.v), x.d / std::sqrt(1.0 - x.v * x.v)};
}

/// The plain number, for decisions that must not depend on derivatives.
inline double value(double x) {
  return x;
}
template <int N>
double value(const Dual<N>& x) {
  return x.v;
}

}  // namespace drift

template <int N>
struct Eigen::NumTraits<drift::Dual<N>> : Eigen::NumTraits<double> {
  using Real = drift::Dual<N>;
  using NonInteger = drift::Dual<N>;
  using Nested = drift::Dual<N>;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = N + 1,
    AddCost = N + 1,
    MulCost = 3 * N + 1
  };
};

template <int N, class Op>
struct Eigen::ScalarBinaryOpTraits<drift::Dual<N>, double, Op> {
  using ReturnType = drift::Dual<N>;
};
template <int N, class Op>
struct Eigen::ScalarBinaryOpTraits<double, drift::Dual<N>, Op> {
  using ReturnType = drift::Dual<N>;
};
