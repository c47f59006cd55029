#pragma once

#include <functional>

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
/// The
/// statistic is that of the deepest point that is found on the way, should the fit have ended in a
/// side valley. fit: whole, of this filter and test. Unchanged where lambda is no state or the fit
/// did not converge. log_gain: what is to be added to the log evidence at one lambda, of all
/// parameters there and the covariance of the others (lambda's own is zero), both scaled; of the
/// density of lambda it is no part.
using LogGain = std::function<double(const VecX& x, const MatX& covariance)>;
EstimateResult over_closure(const FilterSpec& filter, const MeasuredTest& test,
                            const BatchResult& fit, const LogGain& log_gain = {});

/// Whether two fits of one filter and one test ended at one point, as far as a fit tells: both are
/// whole and converged with the same samples, and no further apart than two that stand still
/// within BatchOptions::tolerance of it. over_closure() makes the same of both then.
bool ended_at_one_point(const BatchResult& a, const BatchResult& b);

/// The estimate of a fit by the moments that over_closure() made of another one, which
/// ended_at_one_point() with it.
EstimateResult with_moments_of(const EstimateResult& over, const BatchResult& fit);

}  // namespace drift
