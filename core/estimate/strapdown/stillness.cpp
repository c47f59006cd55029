#include "core/estimate/strapdown/stillness.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/check.hpp"

namespace drift::strapdown {
namespace {

constexpr double much_more_scatter = 2.0, far_apart = 5.0;

/// By how much the halves of a dwell differ.
struct HalvesDiffer {
  Vec3 gyro, acc;
};

std::vector<HalvesDiffer> halves_of(const Signals& signals, const std::vector<Dwell>& dwells) {
  std::vector<HalvesDiffer> all;
  for (const Dwell& d : dwells) {
    const MeanReading first = mean_reading(signals, d.first, middle_of(d)),
                      second = mean_reading(signals, middle_of(d), d.last);
    all.push_back({second.gyro - first.gyro, second.acc - first.acc});
  }
  return all;
}

/// 1 sigma of a half by the median of absolute differences: what was touched does not count.
/// 0.6745: the normal's upper quartile.
double by_median(std::vector<double> absolute) {
  const auto middle = absolute.begin() + static_cast<std::ptrdiff_t>(absolute.size() / 2);
  std::ranges::nth_element(absolute, middle);
  return *middle / (0.6745 * std::numbers::sqrt2);
}

/// The same of what is still by the mean of squares, which knows twice as much.
double by_squares(const std::vector<double>& absolute) {
  double squares = 0.0;
  for (const double a : absolute) squares += a * a;
  return std::sqrt(0.5 * squares / static_cast<double>(absolute.size()));
}

}  // namespace

MeanReading mean_reading(const Signals& signals, std::size_t first, std::size_t last) {
  DRIFT_EXPECTS(first < last);
  MeanReading mean{signals.time[first], signals.time[last]};
  const double inverse = 1.0 / static_cast<double>(last - first);
  for (std::size_t k = first + 1; k <= last; ++k) {
    mean.gyro += inverse * signals.gyro[k];
    mean.acc += inverse * signals.acc[k];
  }
  return mean;
}

Stillness stillness_of(const Signals& signals, const std::vector<Dwell>& dwells) {
  const std::vector<HalvesDiffer> halves = halves_of(signals, dwells);
  Stillness out;
  std::vector<double> scatter;
  for (const Dwell& d : dwells) scatter.push_back(d.gyro_noise.norm());
  std::vector<double> ordered = scatter;
  std::ranges::sort(ordered);
  for (const double s : scatter)
    out.still.push_back(s <= much_more_scatter * ordered[ordered.size() / 4]);
  const auto sizes = [&](Vec3 HalvesDiffer::*sensor) {
    std::vector<double> all;
    for (std::size_t d = 0; d < dwells.size(); ++d)
      if (out.still[d])
        for (int a = 0; a < 3; ++a) all.push_back(std::abs((halves[d].*sensor)[a]));
    return all;
  };
  const double gyro = by_median(sizes(&HalvesDiffer::gyro)),
               acc = by_median(sizes(&HalvesDiffer::acc));
  for (std::size_t d = 0; d < dwells.size(); ++d) {
    const auto near = [&](const Vec3& difference, double sigma) {
      return difference.cwiseAbs().maxCoeff() <= far_apart * std::numbers::sqrt2 * sigma;
    };
    if (!near(halves[d].gyro, gyro) || !near(halves[d].acc, acc)) out.still[d] = false;
  }
  out.gyro_noise = by_squares(sizes(&HalvesDiffer::gyro));
  out.acc_noise = by_squares(sizes(&HalvesDiffer::acc));
  double count = 0.0;
  for (std::size_t d = 0; d < dwells.size(); ++d)
    if (out.still[d]) {
      out.half += 0.5 * dwells[d].duration();
      count += 1.0;
    }
  out.half /= count;
  return out;
}

}  // namespace drift::strapdown
