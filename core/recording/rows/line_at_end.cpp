#include "core/recording/rows/line_at_end.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/nan.hpp"

namespace drift {

double line_at_end(const std::vector<double>& times, const std::vector<double>& values,
                   const RowSpan& rows) {
  const double end = times[rows.end - 1];
  double low = std::numeric_limits<double>::infinity(), high = -low;
  double base = nan_value, count = 0.0, time = 0.0, above = 0.0;  // from the end; from the first
  for (std::size_t row = rows.first; row < rows.end; ++row) {
    if (!std::isfinite(values[row])) continue;
    if (count == 0.0) base = values[row];
    count += 1.0;
    time += times[row] - end;
    above += values[row] - base;
    low = std::min(low, values[row]);
    high = std::max(high, values[row]);
  }
  if (count == 0.0 || 2.0 * count < static_cast<double>(rows.end - rows.first)) return nan_value;
  time /= count;
  above /= count;
  double squares = 0.0, products = 0.0;
  for (std::size_t row = rows.first; row < rows.end; ++row) {
    if (!std::isfinite(values[row])) continue;
    const double away = times[row] - end - time;
    squares += away * away;
    products += away * (values[row] - base - above);
  }
  const double slope = squares > 0.0 ? products / squares : 0.0;
  return std::clamp(base + above - slope * time, low, high);
}

}  // namespace drift
