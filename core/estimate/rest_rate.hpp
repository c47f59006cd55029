#pragma once

#include "core/estimate/linearize.hpp"

namespace drift {

/// What a unit that stands still on the Earth (Interval::rest) says of its gyros: the rate against
/// the Earth that the model reads out of them, w_ip - w_ie in platform axes [rad/s], the mean over
/// the interval. It is zero but for noise. Derivatives with respect to psi_i at the interval's end
/// and to the rate states, from the sensitivities of the interval.
GimbalPrediction predict_rest_rate(const Interval& interval, const Timeline& timeline,
                                   const Vec3* phi, const IntervalSensitivity& sensitivity);

}  // namespace drift
