#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/recording/recording.hpp"

namespace drift::preparation {

/// Takes out the rows in which every accelerometer and gimbal repeats the row before to the last
/// digit: a logger that holds what it read last. How often each channel repeats itself while others
/// do not gives the chance of that (HeldLimits); where readouts are so coarse that it may be, or
/// where a tenth of the rows and more are so (a log that is faster than its sensors), nothing is
/// taken out. Such samples become NaN, with a remark.
void leave_out_held_rows(Recording& recording, std::vector<std::string>& remarks);

/// The recording without them: what its sensors measured.
Recording without_held_rows(Recording recording);

/// Rows in which a sensor stands at one value.
struct StuckRows {
  std::string channel;
  std::size_t first = 0, end = 0;
};

/// Where a sensor stands at one value for far longer than it usually does (RecordingLimits::stuck):
/// stuck, or at the end of its range. In a recording that names positions, also where it does so
/// for longer than chance has it (stuck_by_chance), as often as the channel repeats itself
/// elsewhere, or in that position: of one that never does five readings. One that reads in coarse
/// steps repeats itself as it likes (reading_step()).
std::vector<StuckRows> stuck_rows(const Recording& recording);

/// Takes these out: such samples become NaN, with a remark for each channel.
void leave_out_stuck(Recording& recording, std::vector<std::string>& remarks);

}  // namespace drift::preparation
