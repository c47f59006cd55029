#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/recording/recording.hpp"

namespace drift {

/// The step of a readout that is coarser than its noise, in internal units: its values are whole
/// numbers of steps apart, and of three rows of a position the middle one is mostly within a step
/// of the others' mean, as rounding has it, however fast they move.
///
/// Such a sensor repeats a value for as long as it likes and is not stuck. Empty where noise is of
/// many steps, and where fewer than four values differ from each other, which fit any grid, unless
/// they change in a hundred rows and more: a unit at rest may read one count or none.
/// position: may be null.
std::optional<double> reading_step(const Channel& channel, const Channel* position);

/// The step of a channel's readings that shows, as written or as read out [internal units]; 0:
/// none.
double shown_step(const Recording& recording, const Channel& channel);

/// The largest magnitude that a channel reads; 0 if nothing was measured.
double largest_reading(const Channel& channel);

/// Of the four readings that end at a row: what a drift does is gone in it, white noise of 1 is
/// sqrt(20).
inline double third_difference(const std::vector<double>& x, std::size_t row) {
  return x[row] - 3.0 * x[row - 1] + 3.0 * x[row - 2] - x[row - 3];
}

}  // namespace drift
