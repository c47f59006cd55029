#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/estimate/strapdown/dwells.hpp"
#include "core/recording/recording.hpp"
#include "core/recording/saturation.hpp"

namespace drift::strapdown {

/// Takes out what gyros read at an end of their range, or while they hang in a turn
/// (saturated_gyros()): such cells become NaN, and nothing carries the attitude across two of them
/// in a row. What is taken out comes back.
std::vector<Saturation> leave_out_saturated(Recording& recording);

/// A turn between two dwells.
struct TurnOf {
  std::size_t number = 0;  ///< from 1, behind the dwell of that number; 0: before the first dwell
  double time = 0.0;       ///< of the first of the rows [s]
};

/// The turns that hold these rows, in order. Given a time column as long as the recording.
std::vector<TurnOf> turns_of(const std::vector<std::size_t>& rows, const std::vector<double>& time,
                             const std::vector<Dwell>& dwells);

/// Which gyro in which turns: "gyro_y in turns 3 (at 45.2 s), 7 (at 80 s)".
std::string saturated_turns_text(const Saturation& saturation, const Recording& recording,
                                 const std::vector<Dwell>& dwells);

/// Which gyros, values, how many rows, in which turns between dwells, and what to do; empty: no
/// turn is lost.
std::string saturation_text(const std::vector<Saturation>& all, const Recording& recording,
                            const std::vector<Dwell>& dwells);

}  // namespace drift::strapdown
