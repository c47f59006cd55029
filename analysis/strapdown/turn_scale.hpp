#pragma once

#include <string>
#include <vector>

#include "core/estimate/strapdown/dwells.hpp"
#include "core/physics/earth.hpp"

namespace drift::strapdown {

/// Gyros that turn k times what gravity shows from rest to rest: a scale that no list of units
/// has, or times that are all k times as long. By least squares over the ways on which gravity
/// turns by more than 10 deg: one factor of all gyros, or one of each. It is beyond chance where
/// it is further from one than FitLimits::beyond_prior sigmas of the scale factor's prior and its
/// own, together; that is from the scatter that it leaves.

/// InputError (recording) where three turns or more are off by more than a tenth, and with one
/// factor of all gyros, or else with one of one gyro, none is (GyroUnitLimits::alike). Turns tell
/// scale and times apart no more than that; where the gyros at rest know the Earth's rate about Up
/// well enough that does: times leave it. prior: 1 sigma of a scale factor, the widest that a unit
/// may have.
void require_turn_scale(const Signals& signals, const std::vector<Dwell>& dwells, const Site& site,
                        const std::string& source, double prior);

/// The same of a smaller factor, in words for a remark; empty where there is none. priors: of the
/// three scale factors, 1 sigma. Where they differ by no more than their sigmas and priors let them
/// (chi-square, SearchLimits::alpha) it is one factor, of the gyros or the times.
std::string turn_scale_remark(const Signals& signals, const std::vector<Dwell>& dwells,
                              const Vec3& priors);

}  // namespace drift::strapdown
