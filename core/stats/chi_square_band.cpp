#include "core/stats/chi_square_band.hpp"

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>

#include "core/base/nan.hpp"
#include "core/stats/chi_square.hpp"

namespace drift::stats {

Band chi_square_band(double dof) {
  if (!(dof > 0.0) || !std::isfinite(dof)) return {nan_value, nan_value};
  const double a = 0.5 * dof;
  return {boost::math::gamma_p_inv(a, band_tail) / a, boost::math::gamma_q_inv(a, band_tail) / a};
}

double chi_square_chance(double per_dof, double dof) {
  if (!(dof > 0.0) || !std::isfinite(dof) || std::isnan(per_dof)) return nan_value;
  if (std::isinf(per_dof)) return 0.0;
  const double above = std::exp(log_tail(per_dof * dof, dof));
  return std::min(1.0, 2.0 * std::min(above, boost::math::gamma_p(0.5 * dof, 0.5 * per_dof * dof)));
}

}  // namespace drift::stats
