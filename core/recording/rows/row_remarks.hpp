#pragma once

#include <string>

#include "core/recording/rows/quality_card.hpp"

namespace drift {

/// Where rows of a recording stand: "lines 200 to 259 (position 3, from 1200 s on)".
std::string rows_in_words(const Recording& recording, std::size_t first, std::size_t count);

/// Rows that hold the readings of earlier ones: an error of the log that looks like a measurement.
void remark_repeats(const Recording& recording, QualityCard& card);

/// Gaps, the longest with its place: wrong where it takes a good part of its position, doubtful
/// where it does not, and where few positions follow upon one.
void remark_gaps(QualityCard& card);

}  // namespace drift
