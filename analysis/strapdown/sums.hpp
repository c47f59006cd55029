#pragma once

#include <vector>

#include "analysis/strapdown/findings.hpp"
#include "core/estimate/estimate_result.hpp"

namespace drift::strapdown {

/// What a recording must say of a number, against what its prior says, before it is told: ten times
/// as much information, a posterior below 0.3 prior sigmas.
inline constexpr double learned_ratio = 0.3015;

/// Sums of parameters that a recording knows although it knows none of their members:
/// "D_F_z + D_I_z" at rest. The well known directions of the covariance of all members, in prior
/// sigmas, written in the unit of the largest member; members with less than a fiftieth of its part
/// are left out.
std::vector<StrapdownParameter> known_sums(const EstimateResult& estimate);

}  // namespace drift::strapdown
