#pragma once

#include <string>
#include <vector>

#include "core/estimate/strapdown/dwells.hpp"
#include "core/physics/earth.hpp"

namespace drift::strapdown {

/// InputError (recording) where the gyros turn gravity from dwell to dwell by nothing like what the
/// accelerometers see, and would do so in another unit, or with columns exchanged or reversed
/// (mistaken_columns()).
///
/// Of a way on which gravity turns by more than 10 deg in the case, the error is the angle between
/// gravity as the gyros carry it and as it is seen, against the turn. A right unit leaves a tenth
/// at most, were scale and axes wrong by 5 %. Three ways or more: as declared the median must be
/// above that, otherwise below it and five times smaller. A direction that has nothing to do with
/// gravity is within a tenth of a turn of at most 180 deg with probability 0.024; two of three are,
/// for one of six units, with 0.013 (4 in 10^5 with six ways).
void require_gyro_unit(const Signals& signals, const std::vector<Dwell>& dwells, const Site& site,
                       const std::string& source);

}  // namespace drift::strapdown
