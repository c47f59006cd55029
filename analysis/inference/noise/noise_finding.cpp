#include "analysis/inference/noise/noise_finding.hpp"

#include <cmath>
#include <utility>

#include "analysis/inference/thresholds.hpp"
#include "core/stats/chi_square.hpp"

namespace drift::inference {

NoiseFinding white_finding(std::string component, double factor, double log_sigma,
                           std::size_t rows) {
  const double z = std::log(factor) / log_sigma;
  NoiseFinding f;
  f.component = std::move(component);
  f.factor = f.value = factor;
  f.factor_sigma = factor * log_sigma;
  f.unit = "of declared";
  f.p_value = std::exp(stats::log_tail(z * z, 1.0));
  f.significant = f.p_value < NoiseLimits::significant_p;
  f.log_likelihood_gain = 0.5 * z * z;
  f.count = rows;
  return f;
}

}  // namespace drift::inference
