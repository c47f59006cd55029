#pragma once

#include "core/recording/recording.hpp"

namespace drift {

/// The recording in the units of core/docs/recording.md: s, g, deg, deg/h for commands, deg/s for
/// gyros. The numbers it holds stay as they are; covariates keep their units.
Recording in_canonical_units(Recording recording);

}  // namespace drift
