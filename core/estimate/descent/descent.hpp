#pragma once

#include "core/estimate/batch.hpp"
#include "core/estimate/batch_problem.hpp"

namespace drift {

/// Where a descent ended.
struct Minimum {
  Evaluation at;
  int iterations = 0;
  bool converged = false;
};

/// Levenberg and Marquardt; near the minimum, of a step that goes too far, the best part, and of a
/// model with the moment of a jump the second order that its steps have shown (SecondOrder). Ends
/// where the next step would lower the cost by less than the square of the tolerance: where it
/// would be shorter than that in posterior sigmas. held: a parameter that stays where it is.
Minimum descend(BatchProblem& problem, VecX x, std::vector<Vec3> psi, const BatchOptions& options,
                std::optional<Eigen::Index> held = {});

/// The same for a model in which one parameter multiplies others (lambda the misalignments), so
/// that the cost has a narrow, bent valley: along that parameter, all others at their best for each
/// of its values (variable projection, Golub and Pereyra 1973), the curvature by secants. beside:
/// further values of it, in prior sigmas, the lowest of which is where it begins: far from the
/// valley others lead to the plain beyond.
Minimum descend_along(BatchProblem& problem, VecX x, std::vector<Vec3> psi, Eigen::Index multiplier,
                      const std::vector<double>& beside, const BatchOptions& options);

}  // namespace drift
