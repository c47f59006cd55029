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
/// of sigmas. curvature: a guess of minus the second derivatives. f may be called from several
/// threads at once.
Maximum maximise(const std::function<double(const VecX&)>& f, VecX x, const VecX& curvature);

}  // namespace drift::inference
