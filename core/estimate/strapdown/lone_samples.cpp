#include "core/estimate/strapdown/lone_samples.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/nan.hpp"
#include "core/stats/small_samples.hpp"

namespace drift::strapdown {
namespace {

/// Distance of a sample from the cubic through the two before and the two after it: what noise, and
/// a sample that is off, do to the five around. Noise of sigma has it sigma * sqrt(1.94).
constexpr std::array<double, 5> off_cubic{1.0 / 6.0, -4.0 / 6.0, 1.0, -4.0 / 6.0, 1.0 / 6.0};
constexpr std::size_t reach = 2, beside = 40;
constexpr double of_off = 1.0 + 2.0 * (16.0 + 1.0) / 36.0;  ///< sum of their squares

/// Correlations of that distance of neighbours in white noise: -0.8, 0.4, -0.114, 0.014; 1 + twice
/// the sum of their squares.
constexpr double correlated = 2.63;
/// Degrees of freedom of a mean of 40 squares so correlated.
constexpr double dof = static_cast<double>(beside) / correlated;

std::vector<double> distances(const Signals& s, int axis) {
  std::vector<double> all(s.size(), nan_value);
  for (std::size_t k = reach; k + reach < s.size(); ++k) {
    const double spacing = s.time[k + reach] - s.time[k - reach];
    if (std::abs(spacing - 2.0 * reach * s.interval) > 0.5 * s.interval) continue;
    double sum = 0.0;
    for (std::size_t j = 0; j < off_cubic.size(); ++j)
      sum += off_cubic[j] * s.gyro[k + j - reach][axis];
    all[k] = sum;
  }
  return all;
}

/// Sums of squares of the numbers before each, and how many they are.
struct Sums {
  std::vector<double> squares{0.0};
  std::vector<std::size_t> count{0};
  explicit Sums(const std::vector<double>& values) {
    for (const double v : values) {
      squares.push_back(squares.back() + (std::isfinite(v) ? v * v : 0.0));
      count.push_back(count.back() + (std::isfinite(v) ? 1 : 0));
    }
  }
  /// Mean square from `first` to before `end`; not known where numbers lack.
  double mean_square(std::size_t first, std::size_t end) const {
    const std::size_t n = count[end] - count[first];
    return n < end - first ? nan_value : (squares[end] - squares[first]) / static_cast<double>(n);
  }
};

/// The least change between samples.
double step_of(const Signals& s, int axis) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k < s.size(); ++k) {
    const double change = std::abs(s.gyro[k][axis] - s.gyro[k - 1][axis]);
    if (change > 0.0) least = std::min(least, change);
  }
  return least;
}

}  // namespace

std::vector<LoneSample> lone_gyro_samples(const Signals& signals) {
  constexpr double by_chance = 1e-3, clean = 1e-3;
  std::vector<LoneSample> found;
  const std::size_t margin = beside + 2 * reach + 1;
  if (signals.size() < 2 * margin + 1) return found;
  const double one = by_chance / (3.0 * static_cast<double>(signals.size()));
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<double> distance = distances(signals, axis);
    const Sums sums(distance);
    const double step = step_of(signals, axis);
    if (!std::isfinite(step)) continue;  // it never changes
    for (std::size_t k = margin; k + margin < signals.size(); ++k) {
      // Where its neighbours' are as the sample alone would have them.
      double off = 0.0;
      for (std::size_t j = 0; j < off_cubic.size(); ++j)
        off += off_cubic[j] * distance[k + j - reach] / of_off;
      if (!(std::abs(off) > 2.0 * step)) continue;
      const double before = sums.mean_square(k - 2 * reach - beside, k - 2 * reach),
                   after = sums.mean_square(k + 2 * reach + 1, k + 2 * reach + 1 + beside);
      // Rounding leaves a twelfth of a step squared, where no noise shows.
      const double around = std::max(before + after - std::min(before, after),  // or not known
                                     of_off * step * step / 12.0);
      if (!(off * off * of_off > around * correlated)) continue;  // saves the distribution
      const double t = off / std::sqrt(around * correlated / of_off);
      double left = 0.0;
      for (std::size_t j = 0; j < off_cubic.size(); ++j)
        left += std::pow(distance[k + j - reach] - off * off_cubic[j], 2);
      const double others = static_cast<double>(off_cubic.size()) - 1.0;
      if (stats::beyond_t(t, dof) < one &&
          stats::beyond_f(left / others / around, others, dof) > clean)
        found.push_back({k, axis, off, off * signals.interval});
    }
  }
  std::ranges::sort(found, {}, &LoneSample::sample);
  return found;
}

}  // namespace drift::strapdown
