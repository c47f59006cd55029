#include "core/estimate/descent.hpp"

#include <cmath>
#include <limits>

#include "core/estimate/step_solver.hpp"

namespace drift {
namespace {

/// Small steps may be damping's doing.
constexpr double hardly_damped = 1e-2;

class Descent {
 public:
  Descent(BatchProblem& problem, VecX x, std::vector<Vec3> psi, const BatchOptions& options,
          std::optional<Eigen::Index> held)
      : problem_(problem),
        options_(options),
        held_(held),
        standing_still_(options.tolerance * options.tolerance),
        now_{problem.evaluate(std::move(x), std::move(psi)), 0, false} {}

  Minimum run() {
    while (now_.iterations < options_.max_iterations && !now_.converged && iterate())
      ++now_.iterations;
    return std::move(now_);
  }

 private:
  /// False where it ends.
  bool iterate() {
    const StepSolver solver(now_.at);
    double smallest_change = std::numeric_limits<double>::infinity();
    for (int tries = 0; tries < 20; ++tries) {
      const BatchEquations::Step step = solver.solve(mu_, held_);
      if (mu_ < hardly_damped && step.slope < standing_still_) {
        now_.converged = true;
        return false;
      }
      Moved to = moved(now_.at, step.dx, step.dpsi);
      Evaluation next = problem_.evaluate(std::move(to.x), std::move(to.psi));
      // The last steps change the cost by rounding only: accept them as standing still.
      if (next.cost <= now_.at.cost * (1.0 + 1e-12)) {
        accept(std::move(next));
        return true;
      }
      smallest_change = std::min(smallest_change, next.cost - now_.at.cost);
      mu_ *= 10.0;
    }
    now_.converged = smallest_change < standing_still_;  // up to rounding of the cost
    return false;
  }

  void accept(Evaluation next) {
    still_ = now_.at.cost - next.cost < standing_still_ ? still_ + 1 : 0;
    // Where small steps stay so, the cost has a kink (the onset of a step that crosses a sample)
    // and lies in it.
    now_.converged = still_ > 0 && (mu_ < hardly_damped || still_ == 3);
    now_.at = std::move(next);
    mu_ = std::max(mu_ * 0.1, 1e-12);
  }

  BatchProblem& problem_;
  BatchOptions options_;
  std::optional<Eigen::Index> held_;
  double standing_still_;
  Minimum now_;
  double mu_ = 1e-3;
  int still_ = 0;  ///< iterations in a row that hardly lowered the cost
};

}  // namespace

Minimum descend(BatchProblem& problem, VecX x, std::vector<Vec3> psi, const BatchOptions& options,
                std::optional<Eigen::Index> held) {
  return Descent(problem, std::move(x), std::move(psi), options, held).run();
}

}  // namespace drift
