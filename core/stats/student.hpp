#pragma once

namespace drift::stats {

/// Half width of a two-sided interval of this confidence, in standard deviations of a mean that are
/// themselves known from `dof` degrees of freedom alone: Student's t (Boost.Math). It is
/// normal_half_width() in the limit of many; 12.7 with one, for 95 %. dof > 0.
double t_half_width(double confidence, double dof);

}  // namespace drift::stats
