#pragma once

#include "core/estimate/estimate_result.hpp"

namespace drift::strapdown {

/// Parameters of a platform that is told what its gyros read, in the sensors' convention
/// reading = (1 + s) (C w) + w_l instead of w = C^-1 ((1 + S) reading - w'): of the scale factors
/// 1 + s is 1 / (1 + S), of every drift of a gyro w_l is w' / (1 + S); what bends the scale factor
/// (asymmetry, nonlinearity, temperature) changes its sign, to first order.
EstimateResult as_sensed(EstimateResult of_platform);

/// One value likewise [SI]. scales: the platform's S of gyros x, y, z.
double as_sensed(std::size_t param, double value, const Vec3& scales);

/// The platform's S, where it is estimated; else zero.
Vec3 scales_of(const EstimateResult& of_platform);

}  // namespace drift::strapdown
