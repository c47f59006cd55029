#pragma once

namespace drift::stats {

/// Of a normal deviate over a scale that is itself estimated with `dof` degrees of freedom: the
/// chance of |t| or more (Student).
double beyond_t(double t, double dof);
/// Of the ratio of two mean squares of so many degrees of freedom: the chance of f or more
/// (Fisher).
double beyond_f(double f, double dof_above, double dof_below);

}  // namespace drift::stats
