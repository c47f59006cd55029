#pragma once

#include <cstddef>
#include <vector>

namespace drift {

/// A stretch of rows that becomes one row.
struct RowSpan {
  std::size_t first = 0, end = 0;
};

/// The mean over a stretch of time of what rows are means of.
struct BridgedMean {
  double value = 0.0;    ///< NaN: too little of the stretch is measured
  double seconds = 0.0;  ///< of measuring that its noise is worth: white noise falls by their root
};

/// Rows are means over [begins, ends]; those that are not finite are holes. turned: angle by which
/// what is measured turns against gravity over the stretch [rad].
///
/// Without holes the mean weighted by time, exactly. Holes are bridged by the polynomial through
/// the rows (least squares, each row the mean over its own interval) of the lowest degree that
/// follows a sine of that angle to 2e-6 of its amplitude. Not measured if no degree up to four
/// does, if less than half of the stretch is measured or the polynomial has to reach so far that
/// more than half of what was measured is lost to noise.
BridgedMean bridged_mean(const std::vector<double>& begins, const std::vector<double>& ends,
                         const std::vector<double>& values, const RowSpan& rows, double turned);

}  // namespace drift
