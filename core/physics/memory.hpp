#pragma once

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

/// The mean of that friction over a turn at an even rate, from `torque` on: exact.
template <class S>
S dahl_mean(const S& torque, double turned, const S& x_d) {
  using std::exp;
  const double x = std::abs(turned);
  if (x == 0.0) return torque;
  const double sign = turned > 0.0 ? 1.0 : -1.0;
  const S z = x / x_d;
  // Of small ones exp(-z) - 1 has lost what it differs by.
  const S share =
      z < S(1e-3) ? S(1.0) - z * (0.5 - z * (1.0 / 6.0 - z / 24.0)) : (1.0 - exp(-z)) / z;
  return sign + (torque - sign) * share;
}

/// The turn over which friction builds up, which a filter's step cannot make zero or negative
/// [rad].
template <class S>
S friction_turn(const S& x_d) {
  constexpr double least = 0.1 * detail::deg / 3600.0;  // [rad]
  return at_least(x_d, least);
}

}  // namespace drift
