#include "core/stats/student.hpp"

#include <boost/math/distributions/students_t.hpp>

namespace drift::stats {

double student_tail(double t, double dof) {
  return boost::math::cdf(boost::math::complement(boost::math::students_t(dof), t));
}

}  // namespace drift::stats
