#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/inference/noise.hpp"

namespace drift::inference {

bool grossly_wrong(const LinearProblem& problem, const VecX& residual,
                   const NoiseEstimate& differences) {
  constexpr double gross = 30.0;  // chi-square per row that no plausible noise gives
  double chi2 = 0.0;
  for (Eigen::Index k = 0; k < residual.size(); ++k) {
    const double factor = problem.tags[k].accelerometer() ? differences.model.acc_factor
                                                          : differences.model.gimbal_factor;
    chi2 += residual[k] * residual[k] / (factor * factor);
  }
  return chi2 > gross * static_cast<double>(residual.size());
}

namespace {

/// Robust standard deviation of the residuals of one kind of instrument, at least 1: noise that is
/// merely larger than declared makes no outliers. (Between 1 and 1.1 it is the scatter of the
/// estimate.)
double spread(const LinearProblem& problem, const VecX& residual, bool accelerometers) {
  constexpr double median_of_size = 0.6745;  // of a standard normal
  std::vector<double> sizes;
  for (Eigen::Index k = 0; k < residual.size(); ++k)
    if (problem.tags[static_cast<std::size_t>(k)].accelerometer() == accelerometers)
      sizes.push_back(std::abs(residual[k]));
  if (sizes.empty()) return 1.0;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  const double sigma = *middle / median_of_size;
  return sigma > 1.1 ? sigma : 1.0;
}

}  // namespace

std::size_t robust_weights(LinearProblem& problem, const VecX& whitened) {
  constexpr double corner = 2.5;
  const double acc = spread(problem, whitened, true), gimbal = spread(problem, whitened, false);
  VecX residual = whitened;
  for (Eigen::Index k = 0; k < residual.size(); ++k)
    residual[k] /= problem.tags[static_cast<std::size_t>(k)].accelerometer() ? acc : gimbal;
  const double n = static_cast<double>(residual.size());
  std::size_t far = 0;
  for (const double r : residual) far += std::abs(r) > 3.5;
  const double expected = 4.65e-4 * n;  // Gaussian
  if (static_cast<double>(far) < expected + 4.0 * std::sqrt(expected) + 3.0 ||
      static_cast<double>(far) > 0.02 * n)
    return 0;
  std::size_t lowered = 0;
  for (Eigen::Index k = 0; k < residual.size(); ++k)
    if (std::abs(residual[k]) > corner) {
      problem.weight[k] = std::sqrt(corner / std::abs(residual[k]));
      ++lowered;
    }
  return lowered;
}

}  // namespace drift::inference
