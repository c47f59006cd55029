#pragma once

#include <Eigen/Core>
#include <cmath>
#include <concepts>

namespace drift {

/// A value with N partial derivatives (forward differentiation), so that physics is written once
/// for value and Jacobian. S: the numbers it is made of, double or several at once.
template <int N, class S = double>
struct Dual {
  /// Doubles fill whole registers of four: what is behind the Nth is zero or of no account.
  static constexpr int stored = std::same_as<S, double> && N > 2 ? (N + 3) / 4 * 4 : N;
  using Derivative = Eigen::Array<S, stored, 1>;
  S v = S(0.0);
  Derivative d = Derivative::Constant(S(0.0));

  Dual() = default;
  Dual(const S& value) : v(value) {}  // NOLINT(google-explicit-constructor): a number is a constant
  Dual(double value)                  // NOLINT(google-explicit-constructor)
      requires(!std::same_as<S, double>)
      : v(value) {}
  Dual(const S& value, const Derivative& derivative) : v(value), d(derivative) {}
  /// The variable number i.
  static Dual variable(const S& value, int i) {
    Dual x(value);
    x.d[i] = S(1.0);
    return x;
  }

  [[gnu::always_inline]] Dual& operator+=(const Dual& o) {
    v += o.v;
    d += o.d;
    return *this;
  }
  [[gnu::always_inline]] Dual& operator-=(const Dual& o) {
    v -= o.v;
    d -= o.d;
    return *this;
  }
  [[gnu::always_inline]] Dual& operator*=(const Dual& o) {
    d = d * o.v + v * o.d;
    v *= o.v;
    return *this;
  }
  [[gnu::always_inline]] Dual& operator/=(const Dual& o) {
    v /= o.v;
    d = (d - v * o.d) / o.v;
    return *this;
  }
  [[gnu::always_inline]] friend Dual operator+(Dual a, const Dual& b) { return a += b; }
  [[gnu::always_inline]] friend Dual operator-(Dual a, const Dual& b) { return a -= b; }
  [[gnu::always_inline]] friend Dual operator*(Dual a, const Dual& b) { return a *= b; }
  [[gnu::always_inline]] friend Dual operator/(Dual a, const Dual& b) { return a /= b; }
  friend Dual operator-(const Dual& a) { return {-a.v, -a.d}; }
  friend auto operator<(const Dual& a, const Dual& b) requires std::totally_ordered<S> {
    return a.v < b.v;
  }
  friend auto operator>(const Dual& a, const Dual& b) requires std::totally_ordered<S> {
    return a.v > b.v;
  }
  friend auto operator<=(const Dual& a, const Dual& b) requires std::totally_ordered<S> {
    return a.v <= b.v;
  }
  friend auto operator>=(const Dual& a, const Dual& b) requires std::totally_ordered<S> {
    return a.v >= b.v;
  }
  friend bool operator==(const Dual& a, const Dual& b) requires std::totally_ordered<S> {
    return a.v == b.v;
  }
};

template <int N, class S>
Dual<N, S> sin(const Dual<N, S>& x) {
  using std::cos;
  using std::sin;
  return {sin(x.v), cos(x.v) * x.d};
}
template <int N, class S>
Dual<N, S> cos(const Dual<N, S>& x) {
  using std::cos;
  using std::sin;
  return {cos(x.v), -sin(x.v) * x.d};
}
template <int N, class S>
Dual<N, S> exp(const Dual<N, S>& x) {
  using std::exp;
  const S e = exp(x.v);
  return {e, e * x.d};
}
template <int N, class S>
Dual<N, S> abs(const Dual<N, S>& x) {
  using std::abs;
  using std::copysign;
  return {abs(x.v), x.d * copysign(S(1.0), x.v)};
}
template <int N, class S>
Dual<N, S> sqrt(const Dual<N, S>& x) {
  using std::sqrt;
  const S r = sqrt(x.v);
  return {r, x.d * (S(0.5) / r)};
}
template <int N, class S>
Dual<N, S> tanh(const Dual<N, S>& x) {
  using std::tanh;
  const S t = tanh(x.v);
  return {t, (S(1.0) - t * t) * x.d};
}
template <int N, class S>
Dual<N, S> atan2(const Dual<N, S>& y, const Dual<N, S>& x) {
  using std::atan2;
  const S n = x.v * x.v + y.v * y.v;
  return {atan2(y.v, x.v), (x.v * y.d - y.v * x.d) / n};
}
template <int N, class S>
Dual<N, S> asin(const Dual<N, S>& x) {
  using std::asin;
  using std::sqrt;
  return {asin(x.v), x.d / sqrt(S(1.0) - x.v * x.v)};
}

/// The plain number, for decisions that must not depend on derivatives.
inline double value(double x) {
  return x;
}
template <int N, class S>
double value(const Dual<N, S>& x) {
  return value(x.v);
}

/// x, or `least` (a constant, then) where x is not above it.
inline double at_least(double x, double least) {
  return x > least ? x : least;
}
template <int N>
Dual<N> at_least(const Dual<N>& x, double least) {
  return x.v > least ? x : Dual<N>(least);
}

}  // namespace drift

template <int N, class S>
struct Eigen::NumTraits<drift::Dual<N, S>> : Eigen::NumTraits<double> {
  using Real = drift::Dual<N, S>;
  using NonInteger = drift::Dual<N, S>;
  using Nested = drift::Dual<N, S>;
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

template <int N, class S, class Op>
struct Eigen::ScalarBinaryOpTraits<drift::Dual<N, S>, double, Op> {
  using ReturnType = drift::Dual<N, S>;
};
template <int N, class S, class Op>
struct Eigen::ScalarBinaryOpTraits<double, drift::Dual<N, S>, Op> {
  using ReturnType = drift::Dual<N, S>;
};
