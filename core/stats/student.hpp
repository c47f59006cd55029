#pragma once

namespace drift::stats {

/// P(t > `t`) of Student's t with `dof` degrees of freedom (Boost.Math).
double student_tail(double t, double dof);

}  // namespace drift::stats
