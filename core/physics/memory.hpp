#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/dual.hpp"
#include "core/base/units.hpp"
#include "core/physics/assembly.hpp"

namespace drift {

/// A time constant that a filter's step cannot make zero or negative [s].
template <class S>
S time_constant(const S& tau) {
  constexpr double shortest = 1.0;  // [s]
  return at_least(tau, shortest);
}

/// Solution of tau m' = u(t) - m over a step dt with u linear from u0 to u1: exact.
template <class S>
S lagged(const S& m, double u0, double u1, double dt, const S& tau) {
  using std::exp;
  if (dt <= 0.0) return m;
  const S slope_tau = (u1 - u0) / dt * tau;
  return u1 - slope_tau + (m - u0 + slope_tau) * exp(-dt / tau);
}

/// Dahl friction of exponent 1, in units of its Coulomb torque: dT/dx = (sgn x' - T)/x_d. The
/// solution over a turn x of one sign is exact.
template <class S>
S dahl(const S& torque, double turned, const S& x_d) {
  using std::exp;
  if (turned == 0.0) return torque;
  const double sign = turned > 0.0 ? 1.0 : -1.0;
  return sign + (torque - sign) * exp(-std::abs(turned) / x_d);
}

/// Means over a step of a state, of it times s and of it times s^2; s: the part of the step, 0
/// to 1.
template <class S>
using Moments = std::array<S, 3>;

/// Those of a number that stays.
inline constexpr std::array<double, 3> moments_of_one{1.0, 1.0 / 2.0, 1.0 / 3.0};

/// Of a step in two parts, the first as long as `until`.
template <class S>
Moments<S> joined(double until, const Moments<S>& first, const Moments<S>& second) {
  const double u = until, v = 1.0 - until;
  return {
      u * first[0] + v * second[0], u * u * first[1] + v * (u * second[0] + v * second[1]),
      u * u * u * first[2] + v * (u * u * second[0] + 2.0 * u * v * second[1] + v * v * second[2])};
}

/// Of exp(-z (r s + (1 - r) s^2)), r from 0 to 2: to 1e-10.
template <class S>
Moments<S> decay_moments(const S& z, double r) {
  constexpr double little = 1e-8;
  Moments<S> sum;
  if (z < S(little)) {
    for (std::size_t j = 0; j < 3; ++j) {
      const auto n = static_cast<double>(j + 1);
      sum[j] = 1.0 / n - z * (r / (n + 1.0) + (1.0 - r) / (n + 2.0));
    }
    return sum;
  }
  // By Gauss's rule of 16 points, until nothing is left.
  constexpr double x[] = {0.0950125098376374402, 0.2816035507792589132, 0.4580167776572273863,
                          0.6178762444026437484, 0.7554044083550030339, 0.8656312023878317439,
                          0.9445750230732325761, 0.9894009349916499326};
  constexpr double w[] = {0.1894506104550684963, 0.1826034150449235889, 0.1691565193950025382,
                          0.1495959888165767321, 0.1246289712555338720, 0.0951585116824927848,
                          0.0622535239386478929, 0.0271524594117540949};
  constexpr double nothing_left = 24.0;
  const double until = std::min(1.0, nothing_left / value(z));
  const double last = 2.0 * until / (r + std::sqrt(r * r + 4.0 * (1.0 - r) * until));
  sum.fill(S(0.0));
  for (int k = 0; k < 8; ++k)
    for (const double side : {-1.0, 1.0}) {
      const double s = 0.5 * last * (1.0 + side * x[k]);
      using std::exp;
      const S now = 0.5 * last * w[k] * exp(-z * (s * (r + (1.0 - r) * s)));
      sum[0] += now;
      sum[1] += s * now;
      sum[2] += s * s * now;
    }
  return sum;
}

/// Of that friction over a turn whose rate changes evenly, from `torque` on. begin_rate: at its
/// beginning, over the mean (PathStep).
template <class S>
Moments<S> dahl_moments(const S& torque, double turned, const S& x_d, double begin_rate) {
  const double sign = turned > 0.0 ? 1.0 : -1.0;
  const S away = torque - sign;
  Moments<S> m;
  if (turned == 0.0 || away == S(0.0)) {
    for (std::size_t j = 0; j < 3; ++j) m[j] = moments_of_one[j] * torque;
    return m;
  }
  const Moments<S> decay = decay_moments(S(std::abs(turned) / x_d), begin_rate);
  for (std::size_t j = 0; j < 3; ++j) m[j] = sign * moments_of_one[j] + away * decay[j];
  return m;
}

/// The turn over which friction builds up, which a filter's step cannot make zero or negative
/// [rad].
template <class S>
S friction_turn(const S& x_d) {
  constexpr double least = 0.1 * detail::deg / 3600.0;  // [rad]
  return at_least(x_d, least);
}

}  // namespace drift
