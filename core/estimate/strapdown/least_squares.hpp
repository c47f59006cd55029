#pragma once

#include <functional>

#include "core/base/linalg.hpp"

namespace drift::strapdown {

/// Residuals at x and, unless it is null, their Jacobian (rows: residuals, columns: x).
using Residuals = std::function<VecX(const VecX& x, MatX* jacobian)>;

/// The minimum of a sum of squares.
struct Minimum {
  VecX x;
  VecX residuals;
  MatX jacobian;
  bool converged = false;

  /// Covariance of x if all residuals have the same variance, taken from their sum of squares over
  /// `freedom`, the number of degrees of freedom left.
  MatX covariance(double freedom) const;
};

/// Levenberg-Marquardt, damping scaled by the diagonal of the normal matrix (Marquardt 1963).
Minimum minimise(const Residuals& residuals, const VecX& x);

}  // namespace drift::strapdown
