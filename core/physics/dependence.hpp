#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>

namespace drift {

/// A number that knows which parameters it was made of. Evaluated with it, a term shows which of
/// its slots each of its parameters meets: those that meet in none are differentiated together.
/// A parameter is kept even where it happens to cancel: too much is safe, too little is not.
struct Dependence {
  double v = 0.0;
  std::uint32_t on = 0;  ///< bit k: parameter k of the term

  Dependence() = default;
  Dependence(double value) : v(value) {}  // NOLINT(google-explicit-constructor)
  Dependence(double value, std::uint32_t depends_on) : v(value), on(depends_on) {}

  Dependence& operator+=(const Dependence& o) { return *this = {v + o.v, on | o.on}; }
  Dependence& operator-=(const Dependence& o) { return *this = {v - o.v, on | o.on}; }
  Dependence& operator*=(const Dependence& o) { return *this = {v * o.v, on | o.on}; }
  Dependence& operator/=(const Dependence& o) { return *this = {v / o.v, on | o.on}; }
  friend Dependence operator+(Dependence a, const Dependence& b) { return a += b; }
  friend Dependence operator-(Dependence a, const Dependence& b) { return a -= b; }
  friend Dependence operator*(Dependence a, const Dependence& b) { return a *= b; }
  friend Dependence operator/(Dependence a, const Dependence& b) { return a /= b; }
  friend Dependence operator-(const Dependence& a) { return {-a.v, a.on}; }
  friend bool operator<(const Dependence& a, const Dependence& b) { return a.v < b.v; }
};

inline Dependence sin(const Dependence& x) {
  return {std::sin(x.v), x.on};
}
inline Dependence cos(const Dependence& x) {
  return {std::cos(x.v), x.on};
}
inline Dependence exp(const Dependence& x) {
  return {std::exp(x.v), x.on};
}
inline Dependence abs(const Dependence& x) {
  return {std::abs(x.v), x.on};
}
inline Dependence tanh(const Dependence& x) {
  return {std::tanh(x.v), x.on};
}
inline double value(const Dependence& x) {
  return x.v;
}
inline Dependence at_least(const Dependence& x, double least) {
  return {x.v > least ? x.v : least, x.on};
}

}  // namespace drift

template <>
struct Eigen::NumTraits<drift::Dependence> : Eigen::NumTraits<double> {
  using Real = drift::Dependence;
  using NonInteger = drift::Dependence;
  using Nested = drift::Dependence;
  enum { IsComplex = 0, IsInteger = 0, IsSigned = 1, RequireInitialization = 1 };
};

template <class Op>
struct Eigen::ScalarBinaryOpTraits<drift::Dependence, double, Op> {
  using ReturnType = drift::Dependence;
};
template <class Op>
struct Eigen::ScalarBinaryOpTraits<double, drift::Dependence, Op> {
  using ReturnType = drift::Dependence;
};
