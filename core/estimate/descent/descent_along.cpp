#include <algorithm>
#include <cmath>

#include "core/estimate/descent/descent.hpp"
#include "core/estimate/descent/step_solver.hpp"

namespace drift {
namespace {

/// The floor of the valley at one value of the multiplier, and how it goes on from there.
struct Floor {
  Floor(Minimum minimum, Eigen::Index multiplier)
      : at(std::move(minimum.at)), value(at.x[multiplier]), found(minimum.converged) {
    const StepSolver solver(at);
    const BatchEquations::Step all = solver.solve(0.0, {});
    across = solver.solve(0.0, multiplier);
    step = all.dx[multiplier];
    curvature = step == 0.0 ? 0.0 : std::max(0.0, all.slope - across.slope) / (step * step);
    fall = curvature * step;
    dx_along = all.dx - across.dx;
    dpsi_along = all.dpsi;
    for (std::size_t c = 0; c < dpsi_along.size(); ++c) dpsi_along[c] -= across.dpsi[c];
  }
  /// Where the linear problem has the floor after this step of the multiplier.
  Moved after(double by) const {
    std::vector<Vec3> dpsi = across.dpsi;
    for (std::size_t c = 0; c < dpsi.size(); ++c) dpsi[c] += by / step * dpsi_along[c];
    return moved(at, across.dx + by / step * dx_along, dpsi);
  }

  Evaluation at;
  double value;            ///< of the multiplier, in prior sigmas
  bool found;              ///< the others are at their best
  double step = 0.0;       ///< of the multiplier, to the minimum of the linear problem
  double curvature = 0.0;  ///< half the second derivative along the floor, without residuals
  double fall = 0.0;       ///< half of what the cost falls at along it, per unit
  BatchEquations::Step across;
  VecX dx_along;
  std::vector<Vec3> dpsi_along;
};

/// What is kept of a floor that was left.
struct End {
  double value, cost, fall;
};
End end_of(const Floor& floor) {
  return {floor.value, floor.at.cost, floor.fall};
}

/// Where the cubic through costs and slopes at both ends is least; the middle where it is nowhere
/// between them (Nocedal and Wright, Numerical Optimization, eq. 3.59).
double least_between(const End& a, const End& b) {
  const double width = b.value - a.value, slope_a = -2.0 * a.fall, slope_b = -2.0 * b.fall;
  const double d1 = slope_a + slope_b - 3.0 * (a.cost - b.cost) / (a.value - b.value);
  const double d2 = std::copysign(std::sqrt(d1 * d1 - slope_a * slope_b), width);
  const double at = b.value - width * (slope_b + d2 - d1) / (slope_b - slope_a + 2.0 * d2);
  // Not so near an end that the other would stay for ever.
  constexpr double margin = 0.05;
  const double part = (at - a.value) / width;
  return a.value + width * (std::isfinite(part) ? std::clamp(part, margin, 1.0 - margin) : 0.5);
}

/// The least cost over the multiplier.
class Valley {
 public:
  Valley(BatchProblem& problem, Eigen::Index multiplier, const BatchOptions& options, Minimum begin)
      : problem_(problem),
        multiplier_(multiplier),
        options_(options),
        best_(std::move(begin), multiplier) {}

  Minimum run() {
    const double standing_still = options_.tolerance * options_.tolerance;
    int iterations = 0;
    bool converged = false;
    // Once more than steps are made: to see that there is none left to make.
    for (; best_.found && iterations <= options_.max_iterations && !converged; ++iterations) {
      converged = foreseen() < standing_still;
      if (!converged) take(next_value());
    }
    return {std::move(best_.at), iterations, converged};
  }

 private:
  double curvature() const {
    if (!last_) return best_.curvature;
    const double secant = (last_->fall - best_.fall) / (best_.value - last_->value);
    return secant > 0.0 ? secant : best_.curvature;
  }
  /// By how much the cost may fall yet.
  double foreseen() const {
    if (best_.step == 0.0) return 0.0;
    return best_.fall * best_.fall / std::min(curvature(), best_.curvature);
  }
  double next_value() const {
    if (!bound_) return best_.value + best_.fall / curvature();
    const double newton = best_.value + best_.fall / curvature();
    const bool inside = (newton - best_.value) * (newton - bound_->value) < 0.0;
    return inside && last_falls_well_ ? newton : least_between(end_of(best_), *bound_);
  }
  void take(double value) {
    Moved to = best_.after(value - best_.value);
    Floor next(descend(problem_, std::move(to.x), std::move(to.psi), options_, multiplier_),
               multiplier_);
    if (next.at.cost > best_.at.cost * (1.0 + 1e-12)) {
      last_falls_well_ = false;
      bound_ = last_ = end_of(next);
      return;
    }
    // The minimum lies towards where the cost falls: the old best point, or the old bound.
    const bool beyond = (best_.value - next.value) * next.fall > 0.0;
    last_falls_well_ = std::abs(next.fall) < 0.5 * std::abs(best_.fall);
    last_ = end_of(best_);
    best_ = std::move(next);
    if (beyond) bound_ = last_;
  }

  BatchProblem& problem_;
  Eigen::Index multiplier_;
  BatchOptions options_;
  Floor best_;
  std::optional<End> last_;   ///< the point before
  std::optional<End> bound_;  ///< beyond the minimum, seen from the best point
  bool last_falls_well_ = true;
};

}  // namespace

Minimum descend_along(BatchProblem& problem, VecX x, std::vector<Vec3> psi, Eigen::Index multiplier,
                      const std::vector<double>& beside, const BatchOptions& options) {
  Minimum begin = descend(problem, std::move(x), std::move(psi), options, multiplier);
  for (const double value : beside) {
    VecX there = begin.at.x;
    there[multiplier] = value;
    Minimum other = descend(problem, std::move(there), begin.at.psi, options, multiplier);
    if (other.converged && other.at.cost < begin.at.cost) begin = std::move(other);
  }
  return Valley(problem, multiplier, options, std::move(begin)).run();
}

}  // namespace drift
