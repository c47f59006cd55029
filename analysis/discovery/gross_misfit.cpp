#include <cmath>

#include "analysis/discovery/noise.hpp"

namespace drift::discovery {

bool grossly_wrong(const LinearProblem& problem, const VecX& residual, const NoiseEstimate& differences) {
  constexpr double gross = 30.0;  // chi-square per row that no plausible noise gives
  double chi2 = 0.0;
  for (Eigen::Index k = 0; k < residual.size(); ++k) {
    const double factor =
        problem.tags[k].accelerometer() ? differences.model.acc_factor : differences.model.gimbal_factor;
    chi2 += residual[k] * residual[k] / (factor * factor);
  }
  return chi2 > gross * static_cast<double>(residual.size());
}

std::size_t robust_weights(LinearProblem& problem, const VecX& residual) {
  constexpr double corner = 2.5;
  const double n = static_cast<double>(residual.size());
  std::size_t far = 0;
  for (const double r : residual) far += std::abs(r) > 3.5;
  const double expected = 4.65e-4 * n;  // Gaussian
  if (static_cast<double>(far) < expected + 4.0 * std::sqrt(expected) + 3.0 || static_cast<double>(far) > 0.02 * n)
    return 0;
  std::size_t lowered = 0;
  for (Eigen::Index k = 0; k < residual.size(); ++k)
    if (std::abs(residual[k]) > corner) {
      problem.weight[k] = std::sqrt(corner / std::abs(residual[k]));
      ++lowered;
    }
  return lowered;
}

}  // namespace drift::discovery
