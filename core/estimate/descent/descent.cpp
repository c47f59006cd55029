#include "core/estimate/descent/descent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/estimate/descent/second_order.hpp"
#include "core/estimate/descent/step_solver.hpp"

namespace drift {
namespace {

/// Where the cost is near enough to a parabola: a step that lowers it by less. Squared, as it is.
constexpr double one_sigma = 1.0;
/// Small steps may be damping's doing.
constexpr double hardly_damped = 1e-2;

/// The part of a step at which the parabola through the cost at both its ends, and the slope where
/// it begins, is least: a half where the cost bends twice as much along the step as its rows say,
/// so that it gains nothing. 1 of a step that gains a quarter of what its slope promises (Nocedal
/// and Wright, Numerical Optimization, 4.1), and where the cost need not be a parabola: of one
/// longer than a sigma, or that ends higher than twice its slope.
double best_part(double slope, double change) {
  const bool gains = change <= -0.25 * slope, near = slope < one_sigma && change <= 2.0 * slope;
  return gains || !near ? 1.0 : slope / (change + 2.0 * slope);
}

class Descent {
 public:
  Descent(BatchProblem& problem, VecX x, std::vector<Vec3> psi, const BatchOptions& options,
          std::optional<Eigen::Index> held)
      : problem_(problem),
        options_(options),
        held_(held),
        jumps_(problem.jumps()),
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
      const BatchEquations::Step step = solver.solve(mu_, held_, second_.matrix());
      if (mu_ < hardly_damped && step.slope < standing_still_) {
        // A bend that was learnt elsewhere would make it stand still anywhere.
        if (bends() && solver.solve(mu_, held_).slope >= standing_still_) {
          doubt();
          continue;
        }
        now_.converged = true;
        return false;
      }
      Evaluation next = after(step, 1.0);
      // Farther off than a sigma the rows alone lead the better way.
      if (jumps_ && step.slope < one_sigma)
        second_.learn(now_.at, next);
      else
        second_.forget();
      // Damping shortens steps in directions that are seen little, whichever goes too far.
      if (const double part = best_part(step.slope, next.cost - now_.at.cost); part < 1.0)
        if (Evaluation before = after(step, part); before.cost < next.cost)
          next = std::move(before);
      // The last steps change the cost by rounding only: accept them as standing still.
      if (next.cost <= now_.at.cost * (1.0 + 1e-12)) {
        accept(std::move(next));
        return true;
      }
      smallest_change = std::min(smallest_change, next.cost - now_.at.cost);
      mu_ *= 10.0;
      if (jumps_) mu_ = std::max(mu_, hardly_damped);  // less would change nothing
    }
    now_.converged = smallest_change < standing_still_;  // up to rounding of the cost
    return false;
  }

  Evaluation after(const BatchEquations::Step& step, double part) {
    std::vector<Vec3> dpsi = step.dpsi;
    for (Vec3& d : dpsi) d *= part;
    Moved to = moved(now_.at, part * step.dx, dpsi);
    return problem_.evaluate(std::move(to.x), std::move(to.psi));
  }

  void accept(Evaluation next) {
    still_ = now_.at.cost - next.cost < standing_still_ ? still_ + 1 : 0;
    // Where small steps stay so, the cost has a kink (the onset of a step that crosses a sample)
    // and lies in it.
    now_.converged = still_ > 0 && (mu_ < hardly_damped || still_ == 3);
    now_.at = std::move(next);
    if (now_.converged && bends()) doubt();
    mu_ = std::max(mu_ * 0.1, 1e-12);
  }

  /// Whether steps are of a second order that has not been doubted yet.
  bool bends() const { return !doubted_ && second_.matrix().size() > 0; }
  /// On without it; what is learnt here is believed.
  void doubt() {
    doubted_ = true;
    second_.forget();
    still_ = 0;
    now_.converged = false;
  }

  BatchProblem& problem_;
  BatchOptions options_;
  std::optional<Eigen::Index> held_;
  bool jumps_;  ///< the moment of one is estimated
  double standing_still_;
  Minimum now_;
  SecondOrder second_;
  bool doubted_ = false;
  double mu_ = 1e-3;
  int still_ = 0;  ///< iterations in a row that hardly lowered the cost
};

}  // namespace

Minimum descend(BatchProblem& problem, VecX x, std::vector<Vec3> psi, const BatchOptions& options,
                std::optional<Eigen::Index> held) {
  return Descent(problem, std::move(x), std::move(psi), options, held).run();
}

}  // namespace drift
