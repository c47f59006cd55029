#pragma once

#include "core/estimate/batch_problem.hpp"
#include "core/estimate/normal_equations.hpp"

namespace drift {

/// The linear problem at an evaluation: its normal equations where they are good enough for a step,
/// triangles where they are not.
class StepSolver {
 public:
  explicit StepSolver(const Evaluation& e) : normal_(e.rows, e.psi, e.x) {
    // What a step leaves undone for rounding is met again at the next evaluation, whose residuals
    // and gradient are exact: a thousandth each time.
    constexpr double of_the_prior = 1e-3;
    if (!normal_.good_to(of_the_prior)) triangles_ = compressed(e);
  }
  /// Damped by mu; held: a parameter that stays where it is.
  /// second: what is known of the second order, used where the sum is positive definite and its
  /// digits are good enough.
  BatchEquations::Step solve(double mu, std::optional<Eigen::Index> held,
                             const MatX& second = {}) const {
    return triangles_ ? triangles_->solve(mu, held) : normal_.solve(mu, held, second);
  }

 private:
  NormalEquations normal_;
  std::optional<BatchEquations> triangles_;
};

/// Where a step leads to.
struct Moved {
  VecX x;
  std::vector<Vec3> psi;
};
inline Moved moved(const Evaluation& from, const VecX& dx, const std::vector<Vec3>& dpsi) {
  Moved to{from.x + dx, from.psi};
  for (std::size_t c = 0; c < to.psi.size(); ++c) to.psi[c] += dpsi[c];
  return to;
}

}  // namespace drift
