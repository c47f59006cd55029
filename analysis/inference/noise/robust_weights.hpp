#pragma once

#include <cstddef>

#include "analysis/inference/linear_problem.hpp"

namespace drift::inference {

/// Weights of the rows (MeasuredRows::weight) that lower those with residuals that Gaussian noise
/// does not have (Huber's function with corner 2.5), if there are significantly more of them than
/// it allows, but not so many (2 %) that the model must be wrong; else those the rows have.
/// whitened: residual of about unit variance.
VecX robust_weights(const MeasuredRows& rows, const VecX& whitened);

}  // namespace drift::inference
