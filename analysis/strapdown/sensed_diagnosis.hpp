#pragma once

#include "analysis/diagnosis/findings/diagnosis.hpp"
#include "core/estimate/estimate_result.hpp"

namespace drift::strapdown {

/// Every number that a diagnosis says of a parameter, in the sensors' convention (as_sensed):
/// values, sigmas, intervals, distances from priors and profiles of causes, what moved, amplitudes
/// of candidates. platform: the nominal fit. Where the sensors have the other sign, the ends of an
/// interval change places.
void sense(diagnosis::Diagnosis& d, const EstimateResult& platform);

/// Of D_I_x, D_I_y and D_I_z as causes of one set what differs between them, with intervals and
/// profiles, and a remark: gyros that do not see the Earth do not show their common part. Profiles
/// are of one of them held, the common part free, so intervals are rather too wide.
void take_common_drift_out(diagnosis::Diagnosis& d);

}  // namespace drift::strapdown
