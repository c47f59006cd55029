#include "core/stats/small_samples.hpp"

#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace drift::stats {

double t_half_width(double confidence, double dof) {
  return boost::math::quantile(boost::math::students_t(dof), 0.5 + 0.5 * confidence);
}

double beyond_t(double t, double dof) {
  if (std::isinf(t)) return 0.0;
  return 2.0 * boost::math::cdf(boost::math::complement(boost::math::students_t(dof), std::abs(t)));
}

double beyond_f(double f, double dof_above, double dof_below) {
  if (std::isinf(f)) return 0.0;
  return boost::math::cdf(boost::math::complement(boost::math::fisher_f(dof_above, dof_below), f));
}

}  // namespace drift::stats
