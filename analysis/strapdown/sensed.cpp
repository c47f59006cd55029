#include "analysis/strapdown/sensed.hpp"

#include <cmath>

namespace drift::strapdown {
namespace {

constexpr auto first_scale = TermLibrary::index("s_x");
constexpr auto num_drifts = TermLibrary::index("eta_x");  // the drifts come first in the library
static_assert(TermLibrary::index("D_F_x") == 0 && TermLibrary::index("D_OS_z") < num_drifts);

int axis_of(std::size_t param) {
  return TermLibrary::specs[param].key.view().back() - 'x';
}

bool is_scale(std::size_t param) {
  return param >= first_scale && param < first_scale + 3;
}

/// What makes a scale factor another one: asymmetry, nonlinearity, the temperature.
bool is_bent_scale(std::size_t param) {
  return TermLibrary::owner(param).subsystem == Subsystem::torquer && !is_scale(param);
}

}  // namespace

Vec3 scales_of(const EstimateResult& of_platform) {
  Vec3 scales = Vec3::Zero();
  for (const ParameterEstimate& p : of_platform.parameters)
    if (is_scale(p.param)) scales[axis_of(p.param)] = p.value;
  return scales;
}

double as_sensed(std::size_t param, double value, const Vec3& scales) {
  if (is_scale(param)) return 1.0 / (1.0 + value) - 1.0;
  if (is_bent_scale(param)) return -value;
  return param < num_drifts ? value / (1.0 + scales[axis_of(param)]) : value;
}

EstimateResult as_sensed(EstimateResult e) {
  const Vec3 scales = scales_of(e);
  const auto n = static_cast<Eigen::Index>(e.parameters.size());
  MatX derivative = MatX::Identity(n, n);  // of what is sensed by the platform's, prior-scaled
  for (Eigen::Index k = 0; k < n; ++k) {
    const ParameterEstimate& p = e.parameters[static_cast<std::size_t>(k)];
    if (is_bent_scale(p.param)) derivative(k, k) = -1.0;
    if (!is_scale(p.param) && p.param >= num_drifts) continue;
    const double read = 1.0 / (1.0 + scales[axis_of(p.param)]);
    derivative(k, k) = is_scale(p.param) ? -read * read : read;
    if (is_scale(p.param)) continue;
    for (Eigen::Index j = 0; j < n; ++j) {
      const ParameterEstimate& s = e.parameters[static_cast<std::size_t>(j)];
      if (is_scale(s.param) && axis_of(s.param) == axis_of(p.param))
        derivative(k, j) = -p.value * read * read * s.prior_sigma / p.prior_sigma;
    }
  }
  e.covariance = (derivative * e.covariance * derivative.transpose()).eval();
  for (Eigen::Index k = 0; k < n; ++k) {
    ParameterEstimate& p = e.parameters[static_cast<std::size_t>(k)];
    p.value = as_sensed(p.param, p.value, scales);
    p.sigma = p.prior_sigma * std::sqrt(e.covariance(k, k));
  }
  return e;
}

}  // namespace drift::strapdown
