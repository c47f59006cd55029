#include <gtest/gtest.h>

#include "core/estimate/descent/descent.hpp"
#include "core/estimate/starts.hpp"
#include "core/sim/simulate.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::descent_along_test {
namespace {

using test::param;

constexpr std::size_t starts = 6;

/// Free drift under eq. (5), and a filter that leaves open which equation it was.
struct Scene {
  TruthSpec truth = test::base_truth(Coupling::eq5);
  FilterSpec filter = test::base_filter(Coupling::lambda);
  Readout readout;
  Timeline timeline;
  Measurements measured;
  double truth_lambda = 0.0;

  Scene() {
    PlanDefaults defaults;
    defaults.dwell = 1200.0;
    defaults.sample = 120.0;
    timeline = lay_out(preset_plan("twentyfour", defaults).value(), test::harbin);
    truth.active &= ~test::only({"D_II", "D_OO", "D_SS", "D_IO", "D_IS", "D_OS"});
    filter.active = truth.active;
    filter.active.set(param("lambda"));
    filter.priors[param("lambda")] = TermLibrary::specs[param("lambda")].prior_si();
    const TruthDraw draw = draw_truth(truth, timeline.chains, 1, 0);
    measured = Simulator(truth, readout).run(timeline, draw, 1, 0).measured;
  }
  Theta start(std::size_t k) const { return initial_estimate(filter, 1, k + 2); }
};

TEST(DescentAlong, EveryStartEndsInTheSameMinimumBothEquationsToo) {
  const Scene s;
  const MeasuredTest test{s.timeline, s.readout, s.measured};
  double least = HUGE_VAL, most = -HUGE_VAL;
  for (std::size_t k = 0; k < starts + 2; ++k) {
    Theta start = s.start(k);
    if (k >= starts) start[param("lambda")] = static_cast<double>(k - starts);
    const BatchResult fit = fit_batch(s.filter, test, start);
    EXPECT_EQ(fit.estimate.status, EstimateStatus::ok) << fit.estimate.cause;
    least = std::min(least, fit.estimate.statistic);
    most = std::max(most, fit.estimate.statistic);
    const ParameterEstimate& lambda = *fit.estimate.find(param("lambda"));
    EXPECT_NEAR(lambda.value, s.truth_lambda, 4.0 * lambda.sigma);
    EXPECT_DOUBLE_EQ(lambda.start, start[param("lambda")]);
  }
  // Of one minimum to the tolerance of the fit (1e-4 of a sigma, squared and summed).
  EXPECT_LT(most - least, 1e-3);
}

TEST(DescentAlong, AllParametersAtOnceFailFromSomeStarts) {
  // Else this function would not be needed.
  const Scene s;
  const MeasuredTest test{s.timeline, s.readout, s.measured};
  BatchProblem problem(s.filter, test);
  const std::vector<Vec3> level(static_cast<std::size_t>(s.timeline.chains), Vec3::Zero());
  std::size_t failed = 0;
  for (std::size_t k = 0; k < starts; ++k) {
    const VecX x = problem.layout().scaled(s.start(k));
    const Minimum along = descend_along(problem, x, level, *problem.multiplier(),
                                        problem.both_equations(), {}),
                  at_once = descend(problem, x, level, {});
    EXPECT_TRUE(along.converged);
    EXPECT_LT(along.at.cost, at_once.at.cost + 1e-6);
    failed += at_once.at.cost > along.at.cost + 1.0;
  }
  EXPECT_GT(failed, 0u);
}

}  // namespace
}  // namespace drift::descent_along_test
