// Every term in a whole test: what a model predicts, and what the truth does.
#include "core/sim/predict.hpp"

#include <gtest/gtest.h>

#include "core/base/check.hpp"
#include "core/sim/surroundings.hpp"
#include "tests/support/term_scenes.hpp"

namespace drift::predict_test {
namespace {

using namespace drift::test;

DriftModel model_of(Coupling coupling, const ParamMask& params) {
  return {coupling, TermLibrary::terms_of(params), {}};
}

Measurements predicted(const Timeline& timeline, const DriftModel& model, const Theta& theta) {
  return predict(timeline, model, theta,
                 std::vector<Vec3>(timeline.chains, Vec3(4e-4, -3e-4, 5e-4)), {});
}

TEST(EveryTermInATest, ShowsNothingAtZeroAmplitude) {
  const Timeline timeline = scene("slew12", CommandLaw::level);
  const Theta base = random_theta(5);
  for (const std::size_t t : visible_terms()) {
    if (base_parameters()[TermLibrary::terms[t].first]) continue;
    Theta theta = base;
    set_term(theta, t, 0.0);
    const Coupling coupling = coupling_for(t);
    const Measurements without = predicted(timeline, model_of(coupling, base_parameters()), base);
    const Measurements with =
        predicted(timeline, model_of(coupling, base_parameters() | term_params(t)), theta);
    // One more product of rotations in the gimbal angles: some ulp of an angle of up to pi.
    EXPECT_LT(difference(with, without), 4e-15) << TermLibrary::terms[t].key;
  }
}

/// The temperature of a unit without a thermostat: ten times as far from its mean.
Timeline with_swing(Timeline timeline) {
  for (Interval& i : timeline.intervals)
    for (Covariates* c : {&i.around0, &i.around1}) (*c)[covariate("temperature")] *= 10.0;
  return timeline;
}

TEST(EveryTermInATest, ShowsEachOfItsParameters) {
  // Slews and commands for some, 45-deg attitudes for others, free drift for the rest.
  const Timeline scenes[] = {scene("slew12", CommandLaw::level, 300.0),
                             scene("eighteen", CommandLaw::level, 120.0)};
  const Timeline swinging[] = {with_swing(scenes[0]), with_swing(scenes[1])};
  const Theta base = random_theta(6);
  for (const std::size_t t : visible_terms()) {
    const TermInfo& info = TermLibrary::terms[t];
    Theta theta = base;
    set_term(theta, t);
    for (std::size_t i = info.first; i < info.first + info.count; ++i) {
      const ParamSpec& spec = TermLibrary::specs[i];
      Theta other = theta;
      if (spec.amplitude())
        other[i] += spec.prior_si().sigma();
      else
        other[i] =
            (spec.grid.values[0] == spec.prior.a ? spec.grid.values[1] : spec.grid.values[0]) *
            spec.unit.to_si;
      double most = 0.0;
      for (const Timeline& timeline : info.wants_swing ? swinging : scenes) {
        const DriftModel model = model_of(coupling_for(t), base_parameters() | term_params(t));
        most = std::max(
            most, difference(predicted(timeline, model, theta), predicted(timeline, model, other)));
      }
      EXPECT_GT(most, 1e-9) << spec.key.view();
    }
  }
}

/// Truth without noise, by CVODE.
Simulation truth_run(Coupling coupling, const ParamMask& active, const Timeline& timeline,
                     const Theta& theta) {
  TruthSpec truth = base_truth(coupling);
  truth.active = active;
  Readout readout;
  readout.accelerometer_noise = readout.gimbal_noise = 0.0;
  const TruthDraw draw{theta, std::vector<Vec3>(timeline.chains, Vec3(4e-4, -3e-4, 5e-4))};
  return Simulator(truth, readout).run(timeline, draw, 1, 0);
}

TEST(EveryTermInATest, IsTheSameInTheTruthAndInTheModel) {
  // CVODE at any instant against fixed steps: 1e-3 arcsec in attitude, as without the term. Slews
  // are 3 min of 0.05 rad steps: what they add (1e-3 arcsec each, ReducedModel.TwoIntegratorsAgree)
  // stays.
  const Timeline timeline = scene("slew12", CommandLaw::level);
  for (const std::size_t t : visible_terms()) {
    Theta theta = Theta::Zero();
    theta[param("D_F_x")] = 0.5 * deg_per_h;
    theta[param("eta_y")] = 60.0 * arcsec;
    set_term(theta, t);
    const ParamMask active = only({"D_F", "eta"}) | term_params(t);
    const Simulation sim = truth_run(coupling_for(t), active, timeline, theta);
    ASSERT_TRUE(sim.ode.ok()) << TermLibrary::terms[t].key << ": " << sim.ode.cause;
    Trajectory phi;
    predict(timeline, model_of(coupling_for(t), active), theta, sim.draw.psi0_l, {}, &phi);
    double worst = 0.0;
    for (std::size_t k = 0; k < phi.size(); ++k)
      worst = std::max(worst, (phi[k] - sim.phi[k]).norm());
    constexpr double bound = 2e-3;  // [arcsec]
    EXPECT_LT(worst / arcsec, bound) << TermLibrary::terms[t].key;
    EXPECT_LT(
        difference(predicted(timeline, model_of(coupling_for(t), active), theta), sim.measured),
        bound * arcsec)
        << TermLibrary::terms[t].key;
  }
}

TEST(EveryTermInATest, MayStandBesideAllOthers) {
  const Timeline timeline = scene("slew12", CommandLaw::free);
  Theta theta = random_theta(9);
  ParamMask all;
  for (const std::size_t t : visible_terms()) {
    set_term(theta, t, 0.5);
    all |= term_params(t);
  }
  for (const Coupling coupling : {Coupling::eq5, Coupling::eq6, Coupling::lambda}) {
    const Simulation sim = truth_run(coupling, all, timeline, theta);
    ASSERT_TRUE(sim.ode.ok()) << sim.ode.cause;
    EXPECT_LT(difference(predicted(timeline, model_of(coupling, all), theta), sim.measured),
              5e-3 * arcsec);
  }
}

TEST(EveryTermInATest, ActsInsideTheServoLoop) {
  // The loop closes like eq. (6), so what it makes of every rate term is what eq. (6) predicts:
  // within 0.02 arcsec of transients at the ends of slews.
  TestPlan plan = preset_plan("slew12", PlanDefaults{600.0, 60.0, CommandLaw::level, {}}).value();
  plan.positions.resize(3);
  Timeline timeline = lay_out(plan, harbin);
  set_environment(timeline, harbin_day(), 1, 0);
  read_turns(timeline);
  Theta theta = Theta::Zero();
  ParamMask all;
  for (const std::size_t t : visible_terms()) {
    if (TermLibrary::terms[t].key == closure_term) continue;
    set_term(theta, t, 0.3);
    all |= term_params(t);
  }
  theta[param("dD_t0")] = 1000.0;
  const Simulation sim = truth_run(Coupling::servo, all, timeline, theta);
  ASSERT_TRUE(sim.ode.ok()) << sim.ode.cause;
  EXPECT_LT(difference(predicted(timeline, model_of(Coupling::eq6, all), theta), sim.measured),
            0.02 * arcsec);
}

TEST(Predict, SaysWhichCovariateIsMissing) {
  const Timeline timeline = preset_timeline("six", CommandLaw::level, 600.0);
  const std::vector<Vec3> psi(timeline.chains, Vec3::Zero());
  CovariateSet named = 0;
  for (std::size_t t = 0; t < TermLibrary::num_known; ++t) {
    const TermInfo& term = TermLibrary::terms[t];
    if (term.needs.covariates == 0) continue;
    try {
      predict(timeline, model_of(Coupling::eq5, term_params(t)), Theta::Zero(), psi, {});
      FAIL() << term.key;
    } catch (const InputError& error) {
      EXPECT_EQ(error.code(), ExitCode::recording);
      for (const CovariateSpec& c : known_covariates)
        if ((term.needs.covariates & c.set()) != 0) {
          EXPECT_NE(std::string(error.what()).find(columns_in_words(c)), std::string::npos)
              << error.what();
          named |= c.set();
        }
    }
  }
  EXPECT_EQ(named, every_known_covariate);  // there is none that no term follows
}

}  // namespace
}  // namespace drift::predict_test
