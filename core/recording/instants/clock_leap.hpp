#pragma once

#include <string>
#include <vector>

#include "core/recording/recording.hpp"
#include "core/recording/rows/row_spacing.hpp"

namespace drift {

/// A place where the clock of a log went on by more than time did: summer time, a clock that is
/// set.
struct ClockLeap {
  std::size_t row = 0;   ///< the first one behind it
  double seconds = 0.0;  ///< by how much too much its time is
};

/// Leaps that look like gaps within a position of a platform. Where rows are missing the platform
/// went on turning meanwhile; where the clock leapt it moved by as much as in one row.
///
/// What each gimbal and accelerometer read in the 15 minutes around the gap, on either side of
/// which one and the same command was held, lies on one course of third degree in a time without
/// the gap, but for a step there: zero after a leap, after a gap what the course makes of it. Told
/// where the steps of all channels together are what their noise makes of zero in all but one of
/// 10^6 leaps, and further from those of a gap by odds of e^20 (where the platform does not move
/// nothing is told). Of a gap of hours the way that is told of is that of twenty minutes, as the
/// platform turns back in a day; one that is whole days long is left alone.
std::vector<ClockLeap> clock_leaps(const Recording& recording, const RowSpacing& spacing);

/// Those in words, one sentence with what to do; "" if there are none.
std::string clock_leaps_text(const Recording& recording, const std::vector<ClockLeap>& leaps);
/// The same of all that there are.
std::string clock_leaps_text(const Recording& recording);

}  // namespace drift
