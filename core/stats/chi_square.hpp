#pragma once

namespace drift::stats {

/// Natural log of P(chi-square of `dof` degrees > T), accurate far into the tail: Boost.Math where
/// the probability is a number of double precision, log_far_tail beyond.
double log_tail(double T, double dof);

/// The same for T far above `dof`, down to any size: Legendre's continued fraction of the upper
/// incomplete gamma function,
///
///   Gamma(a, x) = e^-x x^a / (x + 1 - a - 1 (1 - a) / (x + 3 - a - 2 (2 - a) / (x + 5 - a -
///   ...))),
///
/// a = dof/2, x = T/2. Source: Abramowitz and Stegun 6.5.31.
double log_far_tail(double T, double dof);

/// T of `dof` degrees as evidence on one scale: minus the log of its tail probability.
inline double strength(double T, int dof) {
  return dof > 0 ? -log_tail(T, dof) : 0.0;
}

/// The normal number that is as rarely exceeded as T: sigmas above what is usual.
double deviate(double T, double dof);

/// The T of `dof` degrees that has this strength; by bisection.
double quantile_of_strength(double s, int dof);

}  // namespace drift::stats
