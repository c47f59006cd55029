#include "core/estimate/strapdown/least_squares.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/decompose.hpp"

namespace drift::strapdown {

MatX Minimum::covariance(double freedom) const {
  const MatX normal = jacobian.transpose() * jacobian;
  const double variance = residuals.squaredNorm() / std::max(freedom, 1.0);
  return variance * solve_symmetric(normal, MatX(MatX::Identity(normal.rows(), normal.cols())));
}

Minimum minimise(const Residuals& residuals, const VecX& x) {
  constexpr int max_steps = 60;
  constexpr double enough = 1e-9;  // relative fall of the sum of squares
  Minimum at{x, {}, {}, false};
  at.residuals = residuals(x, &at.jacobian);
  if (x.size() == 0) at.converged = true;
  double damping = 1e-6;
  for (int step = 0; step < max_steps && !at.converged; ++step) {
    MatX normal = at.jacobian.transpose() * at.jacobian;
    const VecX gradient = at.jacobian.transpose() * at.residuals;
    const VecX diagonal = normal.diagonal().cwiseMax(1e-300);
    normal.diagonal() += damping * diagonal;
    const VecX candidate = at.x - solve_symmetric(normal, gradient);
    MatX jacobian;
    const VecX r = residuals(candidate, &jacobian);
    const double before = at.residuals.squaredNorm(), after = r.squaredNorm();
    if (!(after < before)) {
      at.converged = std::abs(after - before) <= enough * before || damping > 1e12;
      damping *= 10.0;
      continue;
    }
    at.converged = before - after <= enough * before;
    at.x = candidate;
    at.residuals = r;
    at.jacobian = std::move(jacobian);
    damping = std::max(damping * 0.1, 1e-15);
  }
  return at;
}

}  // namespace drift::strapdown
