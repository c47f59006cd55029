#pragma once

#include "core/estimate/batch.hpp"

namespace drift {

/// The estimate of a batch fit in which lambda is estimated, with mean and covariance of
///
///   p(x | y) = int p(lambda | y) p(x | lambda, y) dlambda,
///   p(lambda | y) ~ exp(-cost(lambda) / 2) |information(lambda)|^-1/2   (Laplace at each lambda)
///
/// in place of the most probable point and the curvature there. A test shows (1 - lambda) E and
/// lambda E (physics.md 1.7): a bent valley, whose curvature at its deepest point says next to
/// nothing of how far it goes. At one lambda the rest is linear to first order in E, so that
/// Laplace's integral is good. The cost is that of the fit, its Gaussian prior of lambda included.
/// fit: whole, of this filter and test. Unchanged where lambda is no state or the fit did not
/// converge.
EstimateResult over_closure(const FilterSpec& filter, const MeasuredTest& test,
                            const BatchResult& fit);

}  // namespace drift
