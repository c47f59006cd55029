#include "analysis/equation/fit_either_equation.hpp"

#include <gtest/gtest.h>

#include "core/estimate/starts.hpp"
#include "core/sim/simulate.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::fit_either_equation_test {
namespace {

using test::param;

constexpr std::size_t starts = 2;

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

TEST(FitEitherEquation, EveryStartEndsInTheSameValleyWhereOneFitDoesNot) {
  const Scene s;
  double least = HUGE_VAL, most = -HUGE_VAL;
  bool alone_fails = false;
  for (std::size_t k = 0; k < starts; ++k) {
    const BatchResult both =
        equation::fit_either_equation(s.filter, {s.timeline, s.readout, s.measured}, s.start(k));
    const BatchResult alone = fit_batch(s.filter, {s.timeline, s.readout, s.measured}, s.start(k));
    EXPECT_EQ(both.estimate.status, EstimateStatus::ok) << both.estimate.cause;
    least = std::min(least, both.estimate.statistic);
    most = std::max(most, both.estimate.statistic);
    const ParameterEstimate& lambda = *both.estimate.find(param("lambda"));
    EXPECT_NEAR(lambda.value, s.truth_lambda, 4.0 * lambda.sigma);
    EXPECT_DOUBLE_EQ(lambda.start, s.start(k)[param("lambda")]);
    alone_fails = alone_fails || alone.estimate.statistic > both.estimate.statistic + 1.0;
  }
  // Of one minimum to the tolerance of the fit (1e-4 of a sigma, squared and summed).
  EXPECT_LT(most - least, 1e-3);
  EXPECT_TRUE(alone_fails);  // else this function would not be needed
}

TEST(FitEitherEquation, IsTheBatchFitWhereTheEquationIsKnown) {
  Scene s;
  s.filter = test::base_filter(Coupling::eq5);
  const BatchResult one =
      equation::fit_either_equation(s.filter, {s.timeline, s.readout, s.measured}, s.start(0));
  const BatchResult two = fit_batch(s.filter, {s.timeline, s.readout, s.measured}, s.start(0));
  EXPECT_EQ(one.estimate.statistic, two.estimate.statistic);
}

}  // namespace
}  // namespace drift::fit_either_equation_test
