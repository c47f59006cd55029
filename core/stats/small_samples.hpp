#pragma once

namespace drift::stats {

/// Half width of a two-sided interval of this confidence, in standard deviations of a mean that are
/// themselves known from `dof` degrees of freedom alone: Student's t (Boost.Math). It is
/// normal_half_width() in the limit of many; 12.7 with one, for 95 %. dof > 0.
double t_half_width(double confidence, double dof);
/// Of a normal deviate over a scale that is itself estimated with `dof` degrees of freedom: the
/// chance of |t| or more (Student).
double beyond_t(double t, double dof);
/// Of the ratio of two mean squares of so many degrees of freedom: the chance of f or more
/// (Fisher).
double beyond_f(double f, double dof_above, double dof_below);

}  // namespace drift::stats
