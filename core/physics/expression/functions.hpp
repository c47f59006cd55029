#pragma once

#include <cmath>

#include "core/base/dual.hpp"
#include "core/physics/dependence.hpp"

namespace drift {

/// What equations need beyond the functions of dual.hpp and dependence.hpp, for any scalar. Where a
/// function has branches the value decides, and the derivative is that of the branch.

inline double log_of(double x) {
  return std::log(x);
}
template <int N, class S>
Dual<N, S> log_of(const Dual<N, S>& x) {
  return {log_of(x.v), x.d / x.v};
}
inline Dependence log_of(const Dependence& x) {
  return {std::log(x.v), x.on};
}

inline double arc_tangent(double x) {
  return std::atan(x);
}
template <int N, class S>
Dual<N, S> arc_tangent(const Dual<N, S>& x) {
  return {arc_tangent(x.v), x.d / (S(1.0) + x.v * x.v)};
}
inline Dependence arc_tangent(const Dependence& x) {
  return {std::atan(x.v), x.on};
}

/// The slope of x^power where x = 0: below a power of 1 infinite in what x follows, and none in
/// what it does not.
template <int N, class S>
typename Dual<N, S>::Derivative slope_at_zero(const Dual<N, S>& x, double power) {
  const double factor = power * std::pow(0.0, power - 1.0);
  return x.d.unaryExpr([&](const S& d) { return value(d) == 0.0 ? S(0.0) : S(d * factor); });
}

inline double root_of(double x) {
  return std::sqrt(x);
}
template <int N, class S>
Dual<N, S> root_of(const Dual<N, S>& x) {
  return value(x) == 0.0 ? Dual<N, S>(root_of(x.v), slope_at_zero(x, 0.5)) : sqrt(x);
}
inline Dependence root_of(const Dependence& x) {
  return {std::sqrt(x.v), x.on};
}

/// A number that is the same all around x; Dependence remembers what it was decided by.
template <class S>
S constant_beside(const S&, double number) {
  return S(number);
}
inline Dependence constant_beside(const Dependence& x, double number) {
  return {number, x.on};
}

template <class S>
S step_at(const S& x) {
  return constant_beside(x, value(x) > 0.0 ? 1.0 : 0.0);
}
template <class S>
S sign_of(const S& x) {
  return constant_beside(x, value(x) > 0.0 ? 1.0 : value(x) < 0.0 ? -1.0 : 0.0);
}

template <class S>
S chosen(const S& one, const S&) {
  return one;
}
inline Dependence chosen(const Dependence& one, const Dependence& other) {
  return {one.v, one.on | other.on};
}
template <class S>
S smaller_of(const S& a, const S& b) {
  return value(a) <= value(b) ? chosen(a, b) : chosen(b, a);
}
template <class S>
S larger_of(const S& a, const S& b) {
  return value(a) >= value(b) ? chosen(a, b) : chosen(b, a);
}

/// x^n for a whole n, which may be negative or zero.
template <class S>
S whole_power(const S& x, int n) {
  S product = constant_beside(x, 1.0);
  for (int k = 0; k < std::abs(n); ++k) product *= x;
  return n < 0 ? S(1.0) / product : product;
}

/// Zero to a power above zero: zero, whatever the power.
inline double zero_power(double, double) {
  return 0.0;
}
inline Dependence zero_power(const Dependence& x, const Dependence& y) {
  return {0.0, x.on | y.on};
}
template <int N, class S>
Dual<N, S> zero_power(const Dual<N, S>& x, const Dual<N, S>& y) {
  return {zero_power(x.v, y.v), slope_at_zero(x, value(y))};
}
/// x^y of a base that is not negative; below zero it is not a number.
template <class S>
S any_power(const S& x, const S& y) {
  using std::exp;
  return value(x) == 0.0 && value(y) > 0.0 ? zero_power(x, y) : S(exp(y * log_of(x)));
}

}  // namespace drift
