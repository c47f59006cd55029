#pragma once

#include "core/recording/rows/quality_card.hpp"

namespace drift {

/// Rows that hold the readings of earlier ones: an error of the log that looks like a measurement.
void remark_repeats(const Recording& recording, QualityCard& card);

/// Gaps, the longest with its place: wrong where it takes a good part of its position, doubtful
/// where it does not, and where few positions follow upon one.
void remark_gaps(QualityCard& card);

}  // namespace drift
