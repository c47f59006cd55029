// The tumble test of inertial sensors: a platform turned about a level axis in equal steps.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/estimate/batch.hpp"
#include "core/sim/simulate.hpp"
#include "tests/support/model_builders.hpp"
#include "tests/support/plan_text.hpp"

namespace drift::tumble_test {
namespace {

using namespace drift::test;

/// Once round about y, which points West, from x North and z Up.
TestPlan tumble(int positions) {
  std::string text = "dwell = \"30 min\"\nsample = \"5 min\"\nmode = \"level\"\n";
  for (int k = 0; k < positions; ++k)
    text += fmt::format("[[plan.position]]\naxes = \"x=N y=W z=U\"\nturn = \"{} deg about y\"\n",
                        360 * k / positions);
  const PlanRead read = read_plan_text(text);
  EXPECT_TRUE(read.mistakes.empty()) << read.mistakes.front();
  return read.config.plan;
}

/// What is true, and what a filter makes of a recording of it.
struct Learned {
  Theta truth;
  EstimateResult by;

  explicit Learned(const TestPlan& plan) {
    const Timeline timeline = lay_out(plan, harbin);
    TruthSpec model = base_truth(Coupling::eq6);
    model.active =
        TermLibrary::completed(only({"D_F", "D_I", "D_O", "D_S", "D_IS_x", "D_OS_y", "D_IO_z"}));
    const Readout readout;
    TruthDraw draw = draw_truth(model, timeline.chains, 7, 0);
    draw.theta[param("D_IS_x")] = 0.12 * deg_per_h;
    draw.theta[param("D_OS_y")] = -0.09 * deg_per_h;
    draw.theta[param("D_IO_z")] = 0.07 * deg_per_h;
    truth = draw.theta;
    const Simulation sim = Simulator(model, readout).run(timeline, draw, 7, 0);
    FilterSpec filter = base_filter(Coupling::eq6);
    filter.active = model.active;
    by = fit_batch(filter, {timeline, readout, sim.measured}, make_layout(filter).theta).estimate;
    EXPECT_EQ(by.status, EstimateStatus::ok) << by.cause;
    EXPECT_NEAR(by.statistic_per_dof(), 1.0,
                5.0 * std::sqrt(2.0 / static_cast<double>(by.measured)));
  }
};

/// f = (-sin, 0, cos) of the angle: of two axes both in the plane that is turned, the gyros x, y
/// and z have (I, S), (O, S) and (I, O), and the products there are -sin cos, which four quarter
/// turns do not show.
constexpr const char* products[] = {"D_IS_x", "D_OS_y", "D_IO_z"};

TEST(Tumble, InStepsOfThirtyDegreesItShowsProductsOfTwoAxes) {
  const Learned steps(tumble(12));
  for (const char* key : products) {
    const ParameterEstimate& p = *steps.by.find(param(key));
    EXPECT_LT(p.sigma, 0.1 * p.prior_sigma) << key;
    EXPECT_LT(std::abs(p.value - steps.truth[param(key)]), 4.0 * p.sigma) << key;
    EXPECT_GT(std::abs(steps.truth[param(key)]), 6.0 * p.sigma)
        << key << " is learned, not believed";
  }
}

TEST(Tumble, InQuarterTurnsItDoesNot) {
  const Learned quarters(tumble(4));
  for (const char* key : products) {
    const ParameterEstimate& p = *quarters.by.find(param(key));
    EXPECT_GT(p.sigma, 0.95 * p.prior_sigma) << key;
  }
}

}  // namespace
}  // namespace drift::tumble_test
