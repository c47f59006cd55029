#pragma once

#include <array>
#include <cstddef>

namespace drift {

/// One step h of the classical fourth-order Runge-Kutta method for y' = f(t, y).
/// State: any fixed-size vector with + and scalar *; f(t, y) returns its derivative.
/// Source: Kutta, Z. Math. Phys. 46, 1901.
template <class State, class F>
State rk4_step(const F& f, double t, const State& y, double h) {
  const State k1 = f(t, y);
  const State k2 = f(t + 0.5 * h, State(y + 0.5 * h * k1));
  const State k3 = f(t + 0.5 * h, State(y + 0.5 * h * k2));
  const State k4 = f(t + h, State(y + h * k3));
  return y + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
}

namespace rkf8 {

/// The 12 stages of Fehlberg's RK7(8)13 that its eighth-order result uses (the 13th serves the
/// error estimate alone). Source: Fehlberg, NASA TR R-287, 1968, table X.
inline constexpr std::size_t stages = 12;
inline constexpr std::array<double, stages> c{0,       2. / 27, 1. / 9, 1. / 6, 5. / 12, 1. / 2,
                                              5. / 6, 1. / 6,  2. / 3, 1. / 3, 0,       1};
inline constexpr std::array<double, stages> b{0,       0,       0,        0,        0, 34. / 105,
                                              9. / 35, 9. / 35, 9. / 280, 9. / 280, 41. / 840, 41. / 840};
inline constexpr std::array<std::array<double, stages - 1>, stages> a{{
    {},
    {2. / 27},
    {1. / 36, 1. / 12},
    {1. / 24, 0, 1. / 8},
    {5. / 12, 0, -25. / 16, 25. / 16},
    {1. / 20, 0, 0, 1. / 4, 1. / 5},
    {-25. / 108, 0, 0, 125. / 108, -65. / 27, 125. / 54},
    {31. / 300, 0, 0, 0, 61. / 225, -2. / 9, 13. / 900},
    {2, 0, 0, -53. / 6, 704. / 45, -107. / 9, 67. / 90, 3},
    {-91. / 108, 0, 0, 23. / 108, -976. / 135, 311. / 54, -19. / 60, 17. / 6, -1. / 12},
    {3. / 205, 0, 0, 0, 0, -6. / 41, -3. / 205, -3. / 41, 3. / 41, 6. / 41},
    {-1777. / 4100, 0, 0, -341. / 164, 4496. / 1025, -289. / 82, 2193. / 4100, 51. / 82, 33. / 164,
     12. / 41, 1},
}};

}  // namespace rkf8

/// One step h of Fehlberg's eighth-order method for y' = f(t, y); arguments as for rk4_step.
template <class State, class F>
State rkf8_step(const F& f, double t, const State& y, double h) {
  std::array<State, rkf8::stages> k;
  for (std::size_t s = 0; s < rkf8::stages; ++s) {
    State y_s = y;
    for (std::size_t j = 0; j < s; ++j)
      if (rkf8::a[s][j] != 0.0) y_s += h * rkf8::a[s][j] * k[j];
    k[s] = f(t + rkf8::c[s] * h, y_s);
  }
  State result = y;
  for (std::size_t s = 0; s < rkf8::stages; ++s)
    if (rkf8::b[s] != 0.0) result += h * rkf8::b[s] * k[s];
  return result;
}

/// `step` applied n times over [t0, t1]: integrate_fixed(rk4_step<Vec3, F>, f, ...) and the like.
template <class Step, class State, class F>
State integrate_fixed(const Step& step, const F& f, double t0, State y, double t1, int n) {
  const double h = (t1 - t0) / n;
  for (int i = 0; i < n; ++i) y = step(f, t0 + i * h, y, h);
  return y;
}

}  // namespace drift
