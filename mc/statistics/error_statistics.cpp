#include "mc/statistics/error_statistics.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/nan.hpp"
#include "core/stats/chi_square.hpp"
#include "core/stats/small_samples.hpp"

namespace drift::mc {
namespace {

/// A root of a mean square whose relative standard error is given: log of the mean square after
/// Student.
Estimated root_between(double root, double relative, std::uint64_t runs, double confidence) {
  if (runs < 2) return {root, nan_value, nan_value};
  const double half =
      0.5 * stats::t_half_width(confidence, static_cast<double>(runs) - 1.0) * relative;
  return {root, root * std::exp(-half), root * std::exp(half)};
}

}  // namespace

void ErrorStatistics::add(double error, double sigma) {
  const double e = error / prior_sigma_, s = sigma / prior_sigma_;
  const double square = e * e, variance = s * s;
  ++n_;
  sum_ += e;
  square_ += square;
  fourth_ += square * square;
  variance_ += variance;
  square_variance_ += square * variance;
  variance_square_ += variance * variance;
  for (std::size_t k = 0; k < coverage_.size(); ++k)
    coverage_[k].count(std::abs(error) < static_cast<double>(k + 1) * sigma);
  magnitudes_.add(magnitude_probability(error / sigma));
}

Estimated ErrorStatistics::bias(double confidence) const {
  const double n = static_cast<double>(n_);
  if (n_ < 2) return {n_ == 1 ? prior_sigma_ * sum_ : nan_value, nan_value, nan_value};
  const double mean = sum_ / n;
  const double spread = std::sqrt(std::max(0.0, square_ / n - mean * mean) * n / (n - 1.0));
  const double half = stats::t_half_width(confidence, n - 1.0) * spread / std::sqrt(n);
  return {prior_sigma_ * mean, prior_sigma_ * (mean - half), prior_sigma_ * (mean + half)};
}

Estimated ErrorStatistics::rmse(double confidence) const {
  if (n_ == 0) return {nan_value, nan_value, nan_value};
  const double n = static_cast<double>(n_), mean = square_ / n;
  const double spread = std::sqrt(std::max(0.0, fourth_ / n - mean * mean) / (n - 1.0));
  return root_between(prior_sigma_ * std::sqrt(mean), mean > 0.0 ? spread / mean : 0.0, n_,
                      confidence);
}

double ErrorStatistics::mean_sigma() const {
  return n_ > 0 ? prior_sigma_ * std::sqrt(variance_ / static_cast<double>(n_)) : nan_value;
}

Estimated ErrorStatistics::deception() const {
  if (n_ == 0) return {nan_value, nan_value, nan_value};
  // Of a ratio R of means: the scatter of square - R variance over the mean square.
  const double n = static_cast<double>(n_), ratio = square_ / variance_;
  const double scatter =
      (fourth_ - 2.0 * ratio * square_variance_ + ratio * ratio * variance_square_) / n;
  const double spread = std::sqrt(std::max(0.0, scatter) / (n - 1.0));
  return root_between(std::sqrt(ratio), square_ > 0.0 ? spread * n / square_ : 0.0, n_, 0.95);
}

double ErrorStatistics::sigmas_above() const {
  const double n = static_cast<double>(n_);
  return n_ > 0 ? stats::deviate(n * square_ / variance_, n) : 0.0;
}

}  // namespace drift::mc
