#pragma once

#include <span>
#include <string_view>

#include "core/recording/recording.hpp"
#include "core/recording/recording_format.hpp"

namespace drift {

/// What some channels would have read so many seconds later (earlier where it is negative).
///
/// Added to each reading is by what a smooth course through its stretch of rows changes in that
/// time, not what is read there: its noise stays its own, as independent from row to row as it was.
/// A stretch is of one position, phase, command and heading of the case, and of `longest_stretch`
/// at the most; the course is a polynomial of the degree that its rows bear, of fourth at the most,
/// without readings that are far from it. In two hours a free platform turns by 30 deg, of which
/// such a polynomial leaves 6e-7 of the specific force. Where three readings or fewer are in a
/// stretch they stay as they are.
///
/// Angles go on through whole turns.
void shift_readings(Recording& recording, std::span<const std::string_view> channels,
                    double seconds);

/// What the readings of some channels scatter by about those courses, each weighed as what its row
/// is a mean of (Recording::samples and readings): 1 sigma of one of these, without
/// readings that are far off. NaN where nothing tells.
double scatter_about_course(const Recording& recording, std::span<const std::string_view> channels);

inline constexpr double longest_stretch = 7200.0;  ///< [s]

/// Brings the accelerometers and the gimbals of a recording to its times, as [recording] says how
/// they were read: momentary accelerometers become what the mean over the interval of their row is,
/// readings that are late what they would have been in time. Nothing where it says nothing.
void take_instants(Recording& recording, const RecordingFormat& format);

}  // namespace drift
