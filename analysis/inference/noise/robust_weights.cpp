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

/// A part of normal residuals that is `times` as large as the rest.
struct Contaminated {
  double part = 0.0, times = 1.0;
  /// Log of the density of an outlier over that of a good sample.
  double log_odds(double r) const {
    return std::log(part / (1.0 - part)) - std::log(times) +
           0.5 * r * r * (1.0 - 1.0 / (times * times));
  }
  double probability(double r) const { return 1.0 / (1.0 + std::exp(-log_odds(r))); }
  /// Log likelihood over that of good samples alone.
  double gain(const VecX& residual) const {
    double sum = static_cast<double>(residual.size()) * std::log1p(-part);
    for (const double r : residual) {
      const double odds = log_odds(r);
      sum += odds > 0.0 ? odds + std::log1p(std::exp(-odds)) : std::log1p(std::exp(odds));
    }
    return sum;
  }
};

/// The mixture of largest likelihood (expectation and maximisation).
Contaminated mixture_of(const VecX& residual) {
  constexpr int most_rounds = 100;
  constexpr double still = 1e-6;
  const double n = static_cast<double>(residual.size());
  Contaminated m{1.0 / n, std::max(3.0, residual.cwiseAbs().maxCoeff())};
  for (int round = 0; round < most_rounds; ++round) {
    double number = 0.0, square = 0.0;
    for (const double r : residual) {
      const double p = m.probability(r);
      number += p;
      square += p * r * r;
    }
    const Contaminated next{std::clamp(number / n, 1e-3 / n, 0.5),
                            std::sqrt(std::max(1.0, square / std::max(number, 1e-300)))};
    const double moved = std::abs(next.part - m.part) * n + std::abs(next.times - m.times);
    m = next;
    if (moved < still || m.times <= 1.0) break;
  }
  return m;
}

}  // namespace

VecX robust_weights(const MeasuredRows& rows, const VecX& whitened) {
  const double acc = spread(rows, whitened, true), gimbal = spread(rows, whitened, false);
  VecX residual = whitened;
  for (Eigen::Index k = 0; k < residual.size(); ++k)
    residual[k] /= rows.tags[static_cast<std::size_t>(k)].accelerometer() ? acc : gimbal;
  VecX weight = rows.weight;
  if (residual.size() == 0) return weight;
  const Contaminated m = mixture_of(residual);
  const double price = std::log(static_cast<double>(residual.size()));  // of two numbers
  if (m.part > SampleLimits::outlier_most || !(m.gain(residual) > price)) return weight;
  for (Eigen::Index k = 0; k < residual.size(); ++k) {
    const double p = m.probability(residual[k]);
    // What is hardly an outlier keeps its weight to the last bit.
    if (p > 0.5) weight[k] /= std::sqrt(1.0 - p + p * m.times * m.times);
  }
  return weight;
}

}  // namespace drift::inference
