#pragma once

#include <string>

#include "core/recording/recording.hpp"
#include "mc/study/study.hpp"

namespace drift::preparation {

/// Whether the heading of the case, recorded or, without a column of it, that of the plan, is off
/// by a constant, and what to write; empty where it is not.
///
/// Where the platform has just been caged, gimbals and heading together show the attitude of the
/// plan. If they are turned from it about Up, by the same angle in every caged position, it is the
/// heading: accelerometers do not see it, and nothing that the platform does begins with it. Said
/// where the angle is larger than caging (GimbalZeroLimits::least of the filters'
/// initial_attitude) and a drift as fast as the Earth make of one row. Smaller ones than
/// largest_mismatch, which is another plan (attitude_mistakes()).
std::string heading_off_zero(const mc::Study& study, const Recording& recording);

}  // namespace drift::preparation
