// Steps that are as fine as a study's own term asks for.
#include "core/sim/own_term_steps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/sim/predict.hpp"
#include "tests/support/model_builders.hpp"
#include "tests/support/own_terms.hpp"

namespace drift::own_term_steps_test {
namespace {

using namespace drift::test;

constexpr double row = 60.0, period = 47.0, A = 0.02;  // [s], [s], [deg/h] or [g]

std::string oscillation(const std::string& acts_on, const std::string& unit) {
  return own_term("own", acts_on, "A*sin(2*pi*t/P)",
                  "A = { unit = '" + unit + "', prior = 0.02 }, P = { unit = 's', value = " +
                      std::to_string(period) + " }");
}
ModelSpec own_model() {
  ModelSpec model;
  model.coupling = Coupling::eq6;
  model.active = params_named("own");
  for (std::size_t i = 0; i < TermLibrary::specs.size(); ++i)
    model.priors[i] = TermLibrary::specs[i].prior_si();
  return model;
}
Timeline six() {
  return preset_timeline("six", CommandLaw::level, 600.0, row);
}
Measurements predicted(const Timeline& timeline, const ModelSpec& model, Trajectory* phi) {
  Theta theta = Theta::Zero();
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i)
    if (model.active[i]) theta[i] = model.priors[i].mean();
  theta[param("own_A")] = model.priors[param("own_A")].sigma();
  return predict(timeline, model.model(), theta, std::vector<Vec3>(timeline.chains, Vec3::Zero()),
                 {}, phi);
}
/// Integral of the oscillation over row k of the test.
double integral(int k) {
  const double w = 2.0 * std::numbers::pi / period;
  return (std::cos(w * row * k) - std::cos(w * row * (k + 1))) / w;
}

TEST(OwnTermSteps, AnOscillationWithinARowIsIntegratedAsItIs) {
  const OwnTermsHeld held(oscillation("rate.x", "deg/h"));
  const ModelSpec model = own_model();
  Timeline timeline = six();
  const auto angle_after_a_row = [&] {
    Trajectory phi;
    predicted(timeline, model, &phi);
    return phi[timeline.intervals[0].last_node()].x();
  };
  const double exact = A * deg_per_h * integral(0), whole = A * deg_per_h * row;
  EXPECT_GT(std::abs(angle_after_a_row() - exact), 2e-3 * whole);
  resolve_own_terms(timeline, model);
  EXPECT_NEAR(angle_after_a_row(), exact, 1e-3 * whole);
  EXPECT_TRUE(timeline.intervals[0].fine);
  EXPECT_TRUE(unresolved_own_terms(timeline, model).empty());
  // Once is enough.
  const std::size_t nodes = timeline.nodes.size();
  resolve_own_terms(timeline, model);
  EXPECT_EQ(timeline.nodes.size(), nodes);
}

TEST(OwnTermSteps, AnAccelerometersMeanIsThatOverTheRow) {
  const OwnTermsHeld held(oscillation("accelerometer.x", "g"));
  const ModelSpec model = own_model();
  Timeline timeline = six();
  double worst = 0.0;
  const auto off = [&](int i) {
    const double without = predicted(timeline, ModelSpec{}, nullptr).acc(0, i);
    return predicted(timeline, model, nullptr).acc(0, i) - without - A * integral(i) / row;
  };
  for (int i = 0; i < 9; ++i) worst = std::max(worst, std::abs(off(i)));
  EXPECT_GT(worst, 1e-2 * A);
  resolve_own_terms(timeline, model);
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(off(i), 0.0, 1e-3 * A) << i;
}

TEST(OwnTermSteps, WhatIsSlowOrReadAtTheEndOfARowLeavesThemAsTheyAre) {
  const Timeline before = six();
  for (const std::string& terms :
       {own_term("own", "rate.x", "A*sin(2*pi*t/P)",
                 "A = { unit = 'deg/h', prior = 0.02 }, P = { unit = 'min', value = 37 }"),
        own_term("own", "drift.y", "A*f_x*f_z", "A = { unit = 'deg/h/g^2', prior = 0.02 }"),
        own_term("own", "gimbal.outer", "A*sin(t/P)",
                 "A = { unit = 'arcsec', prior = 5 }, P = { unit = 's', value = 1 }")}) {
    const OwnTermsHeld held(terms);
    Timeline timeline = before;
    resolve_own_terms(timeline, own_model());
    EXPECT_EQ(timeline.nodes.size(), before.nodes.size()) << terms;
    EXPECT_FALSE(timeline.intervals[0].fine);
  }
}

TEST(OwnTermSteps, AJumpAsksForFineStepsInItsRowAlone) {
  const OwnTermsHeld held(
      own_term("own", "rate.x", "A*step(t - 1245)", "A = { unit = 'deg/h', prior = 0.02 }"));
  Timeline timeline = six();
  resolve_own_terms(timeline, own_model());
  for (const Interval& i : timeline.intervals)
    EXPECT_EQ(i.fine, i.t0 < 1245.0 && 1245.0 < i.t1) << i.t0;
  EXPECT_TRUE(unresolved_own_terms(timeline, own_model()).empty());
}

TEST(OwnTermSteps, WhatRepeatsWithTheFinestStepsIsSaidToBeTooFast) {
  // Of a 64th of a row: a cosine is 1 at every node.
  const OwnTermsHeld held(own_term("own", "rate.x", "A*cos(2*pi*t/P)",
                                   "A = { unit = 'deg/h', prior = 0.02 }, P = { unit = 's', "
                                   "value = 0.9375 }"));
  Timeline timeline = six();
  resolve_own_terms(timeline, own_model());
  const auto all = unresolved_own_terms(timeline, own_model());
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].own, 0u);
  EXPECT_NEAR(all[0].off, std::sqrt(2.0), 0.05);  // 1 for 0, and the rms is 1/sqrt(2)
  EXPECT_EQ(all[0].longest_row, row);
}

}  // namespace
}  // namespace drift::own_term_steps_test
