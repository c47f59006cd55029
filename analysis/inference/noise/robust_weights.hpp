#pragma once

#include <cstddef>

#include "analysis/inference/linear_problem.hpp"

namespace drift::inference {

/// Weights of the rows (MeasuredRows::weight) that lower those of outliers: a part of the samples
/// has noise that is some times larger (a mixture of two normal distributions, both numbers by
/// maximum likelihood), and a row's variance is the mean over what it may be. Those that rows have
/// where the mixture is not worth its two numbers by Schwarz's price, or where so many samples
/// would be outliers that the model must be wrong (2 %). whitened: residual of about unit variance.
/// Source: Tukey 1960 (contaminated normal); Dempster, Laird and Rubin 1977.
VecX robust_weights(const MeasuredRows& rows, const VecX& whitened);

}  // namespace drift::inference
