#pragma once

#include <optional>

#include "core/estimate/batch_equations.hpp"
#include "core/estimate/measurement_equations.hpp"

namespace drift {

/// The least squares problem of BatchEquations by its normal equations: products of the rows in
/// place of reflections, a quarter of the work. Rounding enters with the square of the condition,
/// so whoever needs a covariance or a null direction takes the triangles.
class NormalEquations {
 public:
  /// rows: of each chain, over [psi | x | r]. psi, x: where they were linearised, prior-scaled.
  NormalEquations(const std::vector<ChainEquations>& rows, const std::vector<Vec3>& psi,
                  const VecX& x);

  /// Whether rounding is below `relative` of the information of the prior, which is one: a step is
  /// off by no more in any direction.
  bool good_to(double relative) const;
  /// held: a parameter that stays where it is. second: added to the normal matrix of x where the
  /// sum is positive definite; empty: none.
  BatchEquations::Step solve(double mu, std::optional<Eigen::Index> held = {},
                             const MatX& second = {}) const;

 private:
  std::vector<MatX> chains_;  ///< rows^T rows of each, lower triangle
  const std::vector<Vec3>& psi_;
  const VecX& x_;
};

}  // namespace drift
