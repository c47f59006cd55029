#pragma once

#include <optional>

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

}  // namespace drift
