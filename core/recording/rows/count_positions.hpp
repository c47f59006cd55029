#pragma once

#include <cstddef>
#include <string>

#include "core/base/units.hpp"
#include "core/recording/recording.hpp"

namespace drift {

/// What is a turn to another position, and what is standing in one.
struct CountLimits {
  /// [rad] from row to row, beside what the time between them allows: positions are 10 deg and more
  /// apart (largest_mismatch), and readings of one second scatter by far less.
  static constexpr double turn = 2.0 * detail::deg;
  /// [rad/s] that a platform which stands may turn by: twice Earth rate, half of it drift.
  static constexpr double drift = 1.5e-4;
  /// [rad/s] beyond which a command is a slew: four times what holds a platform level.
  static constexpr double slew = 3.0e-4;
  /// Rows that a platform stands in a position, at least; the first one may still hold a turn.
  static constexpr std::size_t fewest_rows = 4;
};

/// Numbers the positions of a platform's recording that has no column of them: 1, 2, 3, ... in the
/// order in which platform or case stand between turns (gimbals and accelerometers, the heading of
/// the case, commands). Rows in which it is turned by commands, or with its case, are slews to the
/// position that they lead to; those in which it is turned by neither belong to none and are left
/// out. A remark says what was counted. Where `phase` is recorded, slews are what it says.
///
/// Nothing is done, and what stands against it is returned, where a stretch between two turns is
/// shorter than CountLimits::fewest_rows, where the case turns for as long as it stood, or where
/// neither gimbals nor accelerometers are there. Nothing is done and said where a column has them,
/// or where there is no time that goes on. Empty where they were counted.
std::string count_positions(Recording& recording);

}  // namespace drift
