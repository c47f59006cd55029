#pragma once

#include <functional>

#include "core/base/linalg.hpp"

namespace drift::inference {

/// Where a function is largest.
struct Maximum {
  VecX x;
  double value = 0.0;
  MatX
      inverse_curvature;  ///< of minus the function: the covariance of x, if it is a log likelihood
};

/// Climbs from x by BFGS (Nocedal and Wright 2006, eq. 6.17) with forward differences, no step
/// longer than 1 in any coordinate; for smooth functions of coordinates of order one, such as logs
/// of sigmas. inverse_curvature: a guess of that of minus the function. Ends where a step gains, or
/// is foreseen to gain, less than 1e-3. f may be called from several threads at once.
Maximum maximise(const std::function<double(const VecX&)>& f, const VecX& x,
                 const MatX& inverse_curvature);

}  // namespace drift::inference
