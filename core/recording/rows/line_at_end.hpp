#pragma once

#include <vector>

#include "core/recording/rows/bridged_mean.hpp"

namespace drift {

/// What a column reads at the end of a stretch of rows that becomes one: the straight line through
/// its readings, by least squares, at the time of the last row, no farther out than they are. times
/// [s]; readings that are not finite are holes.
///
/// Right to the first order in time, where a mean would be late by half of the stretch; of n
/// readings it has 2 / sqrt(n) of the noise of one. One reading is itself, readings that are equal
/// are what they read. NaN where less than half of the rows have a reading.
double line_at_end(const std::vector<double>& times, const std::vector<double>& values,
                   const RowSpan& rows);

}  // namespace drift
