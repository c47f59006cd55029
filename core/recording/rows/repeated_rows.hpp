#pragma once

#include <cstddef>
#include <vector>

#include "core/recording/recording.hpp"

namespace drift {

/// Rows whose readings are those of earlier rows, number for number.
struct RepeatedRows {
  std::size_t first = 0, again = 0;  ///< where the earlier rows begin, and these
  std::size_t count = 0;             ///< rows
};

/// The chance that noise makes any such rows in a recording is less than this.
inline constexpr double chance_of_repeated_rows = 1e-4;

/// Stretches of rows that read what an earlier stretch reads, by all gyros and accelerometers (or,
/// where there are none, by the gimbal angles), in order. What agrees because it stands still or
/// moves smoothly (no noise, or less than the last decimal place) does not count: only where noise
/// shows, by how often a reading occurs in the stretch, and two stretches anywhere in the recording
/// have to be less likely alike than chance_of_repeated_rows. Ten rows of three noisy channels are.
/// Of more than a hundred thousand rows, short stretches may be passed over. Linear in the rows.
std::vector<RepeatedRows> repeated_rows(const Recording& recording);

/// The last decimal place with which the readings of a channel were written [internal units]; 0 if
/// they have more than nine.
double decimal_step(const Channel& channel);

/// The least difference of readings in order of which most are equal to another; or 0.
double step_between(const std::vector<double>& sorted);

}  // namespace drift
