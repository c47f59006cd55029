// The truth meets what an own term does, however short: its integrator chooses its own steps.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/sim/own_term_steps.hpp"
#include "core/sim/simulate.hpp"
#include "tests/support/model_builders.hpp"
#include "tests/support/own_terms.hpp"

namespace drift::own_term_truth_test {
namespace {

using namespace drift::test;

constexpr double row = 60.0, A = 2.0;  // [s], [deg/h]

TruthSpec truth_with_own() {
  TruthSpec truth;
  truth.coupling = Coupling::eq6;
  truth.active = params_named("own");
  truth.initial_attitude = 0.0;
  for (std::size_t i = 0; i < TermLibrary::specs.size(); ++i)
    truth.priors[i] = TermLibrary::specs[i].prior_si();
  return truth;
}

/// Angle about x at the end of the row before a time [rad], of one dwell of two hours.
class Tested {
 public:
  explicit Tested(const TruthSpec& truth) : truth_(truth) {
    resolve_own_terms(timeline_, truth_);
    draw_ = draw_truth(truth_, timeline_.chains, 1, 0);
    draw_.theta[param("own_A")] = A * deg_per_h;
  }
  void set(const char* key, double value) { draw_.theta[param(key)] = value; }
  Simulation run() { return Simulator(truth_, {}).run(timeline_, draw_, 1, 0); }
  double angle_at(double t) {
    const Simulation sim = run();
    EXPECT_TRUE(sim.ode.ok()) << sim.ode.cause;
    const auto i = std::ranges::find_if(timeline_.intervals,
                                        [&](const Interval& at) { return at.t1 > t - 1.0; });
    return sim.phi[i->last_node()].x();
  }

 private:
  TruthSpec truth_;
  Timeline timeline_ = preset_timeline("six", CommandLaw::level, 7200.0, row);
  TruthDraw draw_;
};

std::string pulse(double from, double to) {
  return own_term("own", "rate.x", "A*step(t - C)*step(F - t)",
                  fmt::format("A = {{ unit = 'deg/h', prior = 2 }}, C = {{ unit = 's', value = {} "
                              "}}, F = {{ unit = 's', value = {} }}",
                              from, to));
}

/// What a rate about x turns the platform by within some minutes; the Earth takes 1e-3 of it to
/// other axes.
void expect_turned(double angle, double seconds) {
  const double turned = A * deg_per_h * seconds;
  EXPECT_NEAR(angle, turned, 2e-3 * turned + A * deg_per_h * row / 64.0) << seconds;
}

TEST(OwnTermTruth, APulseOfMinutesAmidAStretchOfConstantCommandIsMet) {
  for (const double seconds : {20.0, 60.0, 120.0, 300.0})
    for (const double from : {1830.0, 3600.0, 5400.0, 6000.0}) {
      const OwnTermsHeld held(pulse(from, from + seconds));
      Tested test(truth_with_own());
      expect_turned(test.angle_at(std::ceil((from + seconds) / row) * row), seconds);
    }
}

TEST(OwnTermTruth, SoIsOneWhoseTimesAreDrawnElsewhere) {
  const OwnTermsHeld held(pulse(1800.0, 3600.0));
  Tested test(truth_with_own());
  test.set("own_C", 5425.0);
  test.set("own_F", 5445.0);
  expect_turned(test.angle_at(5460.0), 20.0);
}

TEST(OwnTermTruth, AndWhatSwitchesManyTimesInARow) {
  const OwnTermsHeld held(own_term("own", "rate.x", "A*step(sin(2*pi*t/P))",
                                   "A = { unit = 'deg/h', prior = 2 }, P = { unit = 's', value = "
                                   "25 }"));
  Tested test(truth_with_own());
  expect_turned(test.angle_at(600.0), 300.0);
}

TEST(OwnTermTruth, OneThatGrowsWithoutBoundsIsNamedWhereARunFails) {
  const OwnTermsHeld held(
      own_term("own", "rate.x", "A*exp(-t/T)",
               "A = { unit = 'deg/h', prior = 2 }, T = { unit = 'min', value = 30, prior = 60 }"));
  Tested test(truth_with_own());
  test.set("own_T", -60.0);
  const Simulation failed = test.run();
  ASSERT_FALSE(failed.ode.ok());
  EXPECT_TRUE(failed.ode.cause.ends_with(", with own (own_A = 2 deg/h, own_T = -1 min)"))
      << failed.ode.cause;
}

}  // namespace
}  // namespace drift::own_term_truth_test
