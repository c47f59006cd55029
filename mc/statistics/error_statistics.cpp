#include "mc/statistics/error_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/nan.hpp"
#include "core/base/rng.hpp"
#include "core/stats/student.hpp"

namespace drift::mc {
namespace {

/// Poisson number of mean 1 by inversion of its distribution function.
double poisson_one(double u) {
  double p = std::exp(-1.0), below = p;
  int k = 0;
  while (u > below && k < 20) {
    p /= ++k;
    below += p;
  }
  return k;
}

}  // namespace

std::span<const double> BootstrapWeights::of(std::uint64_t run) {
  Stream stream(seed_, run, Purpose::bootstrap);
  for (double& w : weights_) w = poisson_one(stream.uniform());
  return weights_;
}

ErrorStatistics::ErrorStatistics(double prior_sigma, std::size_t replicates)
    : prior_sigma_(prior_sigma), replicates_(replicates) {}

void ErrorStatistics::add(double error, double sigma, std::span<const double> weights) {
  const double e = error / prior_sigma_, s = sigma / prior_sigma_;
  const double square = e * e, variance = s * s;
  ++n_;
  sum_ += e;
  square_ += square;
  fourth_ += square * square;
  variance_ += variance;
  for (std::size_t k = 0; k < coverage_.size(); ++k)
    coverage_[k].count(std::abs(error) < static_cast<double>(k + 1) * sigma);
  magnitudes_.add(magnitude_probability(error / sigma));
  for (std::size_t b = 0; b < replicates_.size(); ++b) {
    replicates_[b].weight += weights[b];
    replicates_[b].square += weights[b] * square;
    replicates_[b].variance += weights[b] * variance;
  }
}

Estimated ErrorStatistics::bias(double confidence) const {
  const double n = static_cast<double>(n_);
  if (n_ < 2) return {n_ == 1 ? prior_sigma_ * sum_ : nan_value, nan_value, nan_value};
  const double mean = sum_ / n;
  const double spread = std::sqrt(std::max(0.0, square_ / n - mean * mean) * n / (n - 1.0));
  const double half = stats::t_half_width(confidence, n - 1.0) * spread / std::sqrt(n);
  return {prior_sigma_ * mean, prior_sigma_ * (mean - half), prior_sigma_ * (mean + half)};
}

template <class Ratio>
Estimated ErrorStatistics::between_replicates(double value, Ratio&& ratio) const {
  std::vector<double> values;
  for (const Replicate& r : replicates_)
    if (r.weight > 0.0) values.push_back(ratio(r));
  if (values.size() < 20 || n_ < 2) return {value, nan_value, nan_value};
  std::ranges::sort(values);
  const auto at = [&](double share) {
    const double place = share * static_cast<double>(values.size() - 1);
    const auto k = static_cast<std::size_t>(place);
    const double rest = place - static_cast<double>(k);
    return k + 1 < values.size() ? (1.0 - rest) * values[k] + rest * values[k + 1] : values[k];
  };
  return {value, at(0.025), at(0.975)};
}

Estimated ErrorStatistics::rmse() const {
  const double value =
      n_ > 0 ? prior_sigma_ * std::sqrt(square_ / static_cast<double>(n_)) : nan_value;
  return between_replicates(
      value, [&](const Replicate& r) { return prior_sigma_ * std::sqrt(r.square / r.weight); });
}

Estimated ErrorStatistics::rmse_normal(double z) const {
  const double n = static_cast<double>(n_);
  if (n_ < 2)
    return {nan_value, -std::numeric_limits<double>::infinity(),
            std::numeric_limits<double>::infinity()};
  const double mean = square_ / n, value = std::sqrt(mean);
  const double spread = std::sqrt(std::max(0.0, fourth_ / n - mean * mean) / (n - 1.0));
  const double half = value > 0.0 ? prior_sigma_ * z * spread / (2.0 * value) : 0.0;
  return {prior_sigma_ * value, prior_sigma_ * value - half, prior_sigma_ * value + half};
}

double ErrorStatistics::mean_sigma() const {
  return n_ > 0 ? prior_sigma_ * std::sqrt(variance_ / static_cast<double>(n_)) : nan_value;
}

Estimated ErrorStatistics::deception() const {
  return between_replicates(n_ > 0 ? std::sqrt(square_ / variance_) : nan_value,
                            [](const Replicate& r) { return std::sqrt(r.square / r.variance); });
}

}  // namespace drift::mc
