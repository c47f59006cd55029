#include "core/stats/allan.hpp"

#include <cmath>
#include <limits>

namespace drift::stats {
namespace {

/// Running sums of a stretch from which its mean is taken off: that changes no difference of means
/// and keeps the digits.
std::vector<double> running_sums(const Stretch& stretch) {
  double mean = 0.0;
  for (const double x : stretch) mean += x / static_cast<double>(stretch.size());
  std::vector<double> sums(stretch.size() + 1, 0.0);
  for (std::size_t k = 0; k < stretch.size(); ++k) sums[k + 1] = sums[k] + (stretch[k] - mean);
  return sums;
}

}  // namespace

std::vector<std::size_t> averaging_counts(std::size_t longest) {
  std::vector<std::size_t> counts;
  for (int third = 0;; ++third) {
    const auto count = static_cast<std::size_t>(std::lround(std::exp2(third / 3.0)));
    if (3 * count > longest) return counts;
    if (counts.empty() || count > counts.back()) counts.push_back(count);
  }
}

std::vector<double> allan_variances(std::span<const Stretch> stretches,
                                    std::span<const std::size_t> counts) {
  std::vector<double> squares(counts.size(), 0.0);
  std::vector<std::size_t> found(counts.size(), 0);
  for (const Stretch& stretch : stretches) {
    const std::vector<double> sums = running_sums(stretch);
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const std::size_t m = counts[i], fit = places(stretch.size(), m);
      double sum = 0.0;
      for (std::size_t k = 0; k < fit; ++k) {
        const double difference = sums[k + 2 * m] - 2.0 * sums[k + m] + sums[k];
        sum += difference * difference;
      }
      squares[i] += sum;
      found[i] += fit;
    }
  }
  std::vector<double> variances(counts.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double m = static_cast<double>(counts[i]);
    if (found[i] > 0) variances[i] = squares[i] / (2.0 * m * m * static_cast<double>(found[i]));
  }
  return variances;
}

}  // namespace drift::stats
