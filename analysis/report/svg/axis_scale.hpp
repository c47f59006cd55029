#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

namespace drift::report {

/// From `low` to `high`; empty until it includes something.
struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  bool empty() const { return !(low <= high); }
  double width() const { return high - low; }
  /// NaN, infinities and numbers no chart can show (beyond 1e100) are left out.
  void include(double value);
  void include(std::span<const double> values);
};

enum class Spacing { linear, logarithmic };

/// A value as it stands on an axis: itself, or its decimal logarithm; NaN of what has none.
double spaced(double value, Spacing spacing);

/// An axis: a range that starts and ends a little outside the data, and round numbers in it.
struct AxisScale {
  Range range;  ///< as values stand on the axis (spaced), the ticks likewise
  std::vector<double> ticks;
  std::vector<std::string> labels;  ///< of the ticks, without the common factor
  std::string factor;               ///< "×10^6" that the labels are to be multiplied by, or empty

  /// Position of a value as it stands on the axis, along `pixels`, clamped far outside; NaN for
  /// what is not shown.
  double at(double value, double pixels) const;
};

/// About `count` ticks of 1, 2 or 5 times a power of ten; on a logarithmic axis powers of ten, with
/// numbers between them where these are fewer than three. data: as values stand on the axis. A
/// constant is shown in the middle of a range of its own; an empty range is 0 to 1.
AxisScale make_scale(const Range& data, int count, double margin,
                     Spacing spacing = Spacing::linear);

}  // namespace drift::report
