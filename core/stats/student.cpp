#include "core/stats/student.hpp"

#include <boost/math/distributions/students_t.hpp>

namespace drift::stats {

double t_half_width(double confidence, double dof) {
  return boost::math::quantile(boost::math::students_t(dof), 0.5 + 0.5 * confidence);
}

}  // namespace drift::stats
