#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/base/units.hpp"
#include "core/recording/own/guess_position.hpp"
#include "core/recording/recording.hpp"

namespace drift {

/// What is a turn to another position, and what is standing in one.
struct CountLimits {
  /// [rad] by which what turns it is elsewhere, beside what it may have drifted meanwhile:
  /// positions are 10 deg and more apart (largest_mismatch).
  static constexpr double turn = 2.0 * detail::deg;
  /// [rad/s] that a platform which stands may turn by: twice Earth rate, half of it drift.
  static constexpr double drift = 1.5e-4;
  /// From row to row what stands turns by no more than so many times what the quietest fifth of a
  /// log's rows do at most, for most of the rows may be on the way (of normal noise of three angles
  /// one row in 1e7 does), and so much [rad].
  static constexpr double usual = 6.0, still = 0.02 * detail::deg;
  /// [rad/s] beyond which a command is a slew: four times what holds a platform level.
  static constexpr double slew = 3.0e-4;
  /// Rows that a platform stands in a position, at least; the first one may still hold a turn.
  static constexpr std::size_t fewest_rows = PositionLimits::fewest_rows;
};

/// The fact of a recording whose positions were counted: how many.
inline constexpr std::string_view positions_counted = "positions_counted";

/// Numbers the positions of a platform's recording that has no column of them: 1, 2, 3, ... in the
/// order in which platform or case stand between turns (gimbals, or else accelerometers; the
/// heading of the case; commands). Rows in which it is turned by commands, or the case below it,
/// are slews to the position that they lead to. Those in which it is turned by neither belong to
/// none and are left out; of the row in which it arrives, the gimbals at its end are kept and the
/// accelerometers' mean is not measured. Left out is also what a log has before the first position
/// and behind the last one. A remark says what was counted, and the fact positions_counted. Where
/// `phase` is recorded, slews are what it says.
///
/// Nothing is done, and what stands against it is returned, where a stretch between two turns is
/// shorter than CountLimits::fewest_rows, where the case turns for as long as it stood, or where
/// neither gimbals nor accelerometers are there. Nothing is done and said where a column has them,
/// or where there is no time that goes on. Empty where they were counted.
std::string count_positions(Recording& recording);

}  // namespace drift
