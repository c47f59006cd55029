#pragma once

#include <optional>
#include <vector>

#include "core/base/linalg.hpp"

namespace drift {

/// The linear least squares problem of a batch fit at one point, ready to be solved for any
/// damping: n parameters x scaled by their priors, and the attitude psi at each caging.
struct BatchEquations {
  std::vector<MatX>
      chains;  ///< triangles over [psi | x | r], shape (3 + n + 1, 3 + n + 1), data alone
  std::vector<Vec3> psi;  ///< present attitude errors, scaled by their prior sigma
  VecX x;                 ///< present scaled parameters

  struct Step {
    VecX dx;
    std::vector<Vec3> dpsi;
    /// Half of what the cost would fall along all of it at its first rate: -(gradient, step) / 2.
    /// Undamped, the whole of what the linear problem has it fall.
    double slope = 0.0;
  };

  /// Minimises |J d - r|^2 + |p + d|^2 + mu |d|^2. held: a parameter that stays where it is.
  Step solve(double mu, std::optional<Eigen::Index> held = {}) const;
  struct Reduced {
    MatX triangle;           ///< over [x | r], no parameter prior
    std::vector<MatX> tops;  ///< of each chain: the rows that give its attitude
  };
  /// With every attitude eliminated.
  Reduced reduced(double mu) const;
};

}  // namespace drift
