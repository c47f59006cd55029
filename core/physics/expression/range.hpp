#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace drift {

/// All that a part of an equation can come to while what it sees moves from one end of a stretch to
/// the other. An equation evaluated with it shows whether it is a finite number everywhere in
/// between; where its parts follow the same thing it may come out wider than it is, and shrinks to
/// the truth as the stretch does.
struct Range {
  double lo = 0.0, hi = 0.0;
  bool everywhere = true;  ///< finite at every point of the stretch; else the ends mean nothing

  Range() = default;
  Range(double number) : Range(number, number) {}  // NOLINT(google-explicit-constructor)
  Range(double low, double high, bool everywhere_ = true)
      : lo(low), hi(high), everywhere(everywhere_ && std::isfinite(low) && std::isfinite(high)) {}
  static Range broken() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {-infinity, infinity, false};
  }
};

/// A function that rises, or falls, throughout.
template <class Function>
Range monotone(const Range& x, Function&& f) {
  if (!x.everywhere) return Range::broken();
  const double a = f(x.lo), b = f(x.hi);
  return {std::min(a, b), std::max(a, b)};
}

inline Range operator+(const Range& a, const Range& b) {
  return {a.lo + b.lo, a.hi + b.hi, a.everywhere && b.everywhere};
}
inline Range operator-(const Range& a) {
  return {-a.hi, -a.lo, a.everywhere};
}
inline Range operator-(const Range& a, const Range& b) {
  return a + -b;
}
inline Range operator*(const Range& a, const Range& b) {
  if (!a.everywhere || !b.everywhere) return Range::broken();
  const auto [least, most] = std::minmax({a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi});
  return {least, most};
}
inline Range operator/(const Range& a, const Range& b) {
  if (b.lo <= 0.0 && b.hi >= 0.0) return Range::broken();
  return a * monotone(b, [](double v) { return 1.0 / v; });
}

inline Range exp(const Range& x) {
  return monotone(x, [](double v) { return std::exp(v); });
}
inline Range tanh(const Range& x) {
  return monotone(x, [](double v) { return std::tanh(v); });
}
inline Range arc_tangent(const Range& x) {
  return monotone(x, [](double v) { return std::atan(v); });
}
inline Range abs(const Range& x) {
  const double most = std::max(-x.lo, x.hi);
  return {std::max({x.lo, -x.hi, 0.0}), most, x.everywhere};
}
/// Its crests lie at pi/2 + 2 pi k, its troughs half a turn from them.
inline Range sin(const Range& x) {
  constexpr double turn = 2.0 * std::numbers::pi, crest = 0.5 * std::numbers::pi;
  if (!x.everywhere) return Range::broken();
  const auto holds = [&](double at) { return at + turn * std::ceil((x.lo - at) / turn) <= x.hi; };
  const double a = std::sin(x.lo), b = std::sin(x.hi);
  return {holds(-crest) ? -1.0 : std::min(a, b), holds(crest) ? 1.0 : std::max(a, b)};
}
inline Range cos(const Range& x) {
  return sin(x + Range(0.5 * std::numbers::pi));
}
inline Range log_of(const Range& x) {
  return x.lo > 0.0 ? monotone(x, [](double v) { return std::log(v); }) : Range::broken();
}
inline Range root_of(const Range& x) {
  return x.lo >= 0.0 ? monotone(x, [](double v) { return std::sqrt(v); }) : Range::broken();
}
inline Range step_at(const Range& x) {
  return monotone(x, [](double v) { return v > 0.0 ? 1.0 : 0.0; });
}
inline Range sign_of(const Range& x) {
  return monotone(x, [](double v) { return v > 0.0 ? 1.0 : v < 0.0 ? -1.0 : 0.0; });
}
inline Range smaller_of(const Range& a, const Range& b) {
  return {std::min(a.lo, b.lo), std::min(a.hi, b.hi), a.everywhere && b.everywhere};
}
inline Range larger_of(const Range& a, const Range& b) {
  return {std::max(a.lo, b.lo), std::max(a.hi, b.hi), a.everywhere && b.everywhere};
}
inline Range whole_power(const Range& x, int n) {
  if (n < 0) return Range(1.0) / whole_power(x, -n);
  return monotone(n % 2 == 0 ? abs(x) : x, [&](double v) { return std::pow(v, n); });
}
inline Range any_power(const Range& x, const Range& y) {
  if (x.lo > 0.0) return exp(y * log_of(x));
  if (x.lo < 0.0 || y.lo <= 0.0) return Range::broken();
  const Range most = x.hi > 0.0 ? any_power(Range(x.hi), y) : Range(0.0);  // zero stays zero
  return {0.0, most.hi, most.everywhere && x.everywhere};
}

}  // namespace drift
