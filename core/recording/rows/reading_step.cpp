#include "core/recording/rows/reading_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/recording/rows/repeated_rows.hpp"

namespace drift {
namespace {

constexpr double step_rounding = 1e-3;  ///< [steps] of a decimal text, and of its conversion
constexpr std::size_t fewest_values = 4, fewest_bends = 100;

bool is_whole(double steps) {
  return std::abs(steps - std::round(steps)) < step_rounding;
}

/// The least distance of sorted values, or of their distances: rows that move by 4 and by 5 steps
/// are steps apart. Infinite if all are one.
double finest(const std::vector<double>& values) {
  std::vector<double> apart;
  for (std::size_t i = 1; i < values.size(); ++i)
    if (values[i] > values[i - 1]) apart.push_back(values[i] - values[i - 1]);
  if (apart.empty()) return std::numeric_limits<double>::infinity();
  std::ranges::sort(apart);
  double least = apart.front();
  for (std::size_t i = 1; i < apart.size(); ++i)
    if (const double more = apart[i] - apart[i - 1]; more > 10.0 * step_rounding * apart.front())
      least = std::min(least, more);
  return least;
}

}  // namespace

std::optional<double> reading_step(const Channel& channel, const Channel* position) {
  const std::vector<double>& x = channel.values;
  std::vector<double> values;
  for (const double value : x)
    if (std::isfinite(value)) values.push_back(value);
  std::ranges::sort(values);
  const double step0 = finest(values);
  if (!std::isfinite(step0)) return std::nullopt;
  // The least difference has the errors of two texts; the range has them shared out.
  const double range = values.back() - values.front();
  const double step = range / std::round(range / step0);
  std::size_t different = 1;
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (!is_whole((values[i] - values[i - 1]) / step)) return std::nullopt;
    different += values[i] > values[i - 1] ? 1 : 0;
  }
  std::size_t bends = 0, small = 0;
  for (std::size_t i = 2; i < x.size(); ++i) {
    if (position && position->values[i] != position->values[i - 2]) continue;
    const double steps = std::abs(x[i] - 2.0 * x[i - 1] + x[i - 2]) / step;
    if (!(steps > 0.5)) continue;  // or not measured
    ++bends;
    small += steps < 2.5 ? 1 : 0;
  }
  if (2 * small < bends || (different < fewest_values && bends < fewest_bends)) return std::nullopt;
  return step;
}

double shown_step(const Recording& recording, const Channel& channel) {
  std::vector<double> sorted = channel.values;
  std::erase_if(sorted, [](double x) { return std::isnan(x); });
  std::ranges::sort(sorted);
  return std::max({decimal_step(channel), step_between(sorted),
                   reading_step(channel, recording.find("position")).value_or(0.0)});
}

double largest_reading(const Channel& channel) {
  double largest = 0.0;
  for (const double x : channel.values)
    if (std::isfinite(x)) largest = std::max(largest, std::abs(x));
  return largest;
}

}  // namespace drift
