#include "analysis/inference/noise/robust_weights.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/inference/thresholds.hpp"
#include "core/stats/median.hpp"

namespace drift::inference {
namespace {

/// Robust standard deviation of the residuals of one kind of instrument, at least 1: noise that is
/// merely larger than declared makes no outliers. (Between 1 and 1.1 it is the scatter of the
/// estimate.)
double spread(const MeasuredRows& rows, const VecX& residual, bool accelerometers) {
  constexpr double median_of_size = 0.6745;  // of a standard normal
  std::vector<double> sizes;
  for (Eigen::Index k = 0; k < residual.size(); ++k)
    if (rows.tags[static_cast<std::size_t>(k)].accelerometer() == accelerometers)
      sizes.push_back(std::abs(residual[k]));
  if (sizes.empty()) return 1.0;
  const double sigma = stats::upper_median(std::move(sizes)) / median_of_size;
  return sigma > SampleLimits::spread ? sigma : 1.0;
}

}  // namespace

VecX robust_weights(const MeasuredRows& rows, const VecX& whitened) {
  constexpr double corner = SampleLimits::huber;
  const double acc = spread(rows, whitened, true), gimbal = spread(rows, whitened, false);
  VecX residual = whitened;
  for (Eigen::Index k = 0; k < residual.size(); ++k)
    residual[k] /= rows.tags[static_cast<std::size_t>(k)].accelerometer() ? acc : gimbal;
  const double n = static_cast<double>(residual.size());
  std::size_t far = 0;
  for (const double r : residual) far += std::abs(r) > SampleLimits::outlier;
  const double expected = SampleLimits::outlier_share * n;
  VecX weight = rows.weight;
  if (static_cast<double>(far) < expected + SampleLimits::outlier_sigmas * std::sqrt(expected) +
                                     SampleLimits::outlier_room ||
      static_cast<double>(far) > SampleLimits::outlier_most * n)
    return weight;
  for (Eigen::Index k = 0; k < residual.size(); ++k)
    if (std::abs(residual[k]) > corner) weight[k] = std::sqrt(corner / std::abs(residual[k]));
  return weight;
}

}  // namespace drift::inference
