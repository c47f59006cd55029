#pragma once

#include <span>

#include "core/estimate/strapdown/rotation.hpp"

namespace drift::strapdown {

/// Estimates `params` (of s, eta, xi) from rotations by least squares on the predicted directions
/// up, with the drift taken from the dwells. Its covariance includes that of the drift. Under eq.
/// (6) the rotations do not contain eta and xi: they stay zero, with infinite variance.
Estimate fit_rotations(std::span<const Rotation> rotations, Coupling equation,
                       const Estimate& drift, std::span<const std::size_t> params);

}  // namespace drift::strapdown
