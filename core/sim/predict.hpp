#pragma once

#include "core/sim/measurements.hpp"
#include "core/sim/trajectory.hpp"

namespace drift {

/// What a model says the instruments will show, without noise: fixed-step integration, every hook
/// of every active term. psi0_l: initial attitude error of each chain, local axes [rad]. Channels
/// that `readout` does not have are NaN. InputError (recording) if a term needs a covariate that
/// the timeline does not carry. Not for coupling "servo". phi: the platform's motion, if asked for.
Measurements predict(const Timeline& timeline, const DriftModel& model, const Theta& theta,
                     const std::vector<Vec3>& psi0_l, const Readout& readout,
                     Trajectory* phi = nullptr);

}  // namespace drift
