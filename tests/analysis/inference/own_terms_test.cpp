// A term that a study brings, written as one of the library: it must be that one in every way.
#include "tests/support/own_terms.hpp"

#include <gtest/gtest.h>

#include "analysis/inference/candidate.hpp"
#include "analysis/inference/signatures.hpp"
#include "core/physics/hooks.hpp"
#include "tests/support/estimators.hpp"
#include "tests/support/term_scenes.hpp"

namespace drift::own_terms_test {
namespace {

using namespace drift::test;

/// A parameter of the library and the same effect as an own term "twin" with the amplitude "A".
struct Twin {
  const char* key;
  const char* acts_on;
  const char* equation;
  const char* parameters;
  double scale = 1.0;  ///< of its amplitude over the library's, SI
};
const Twin twins[] = {
    {"ramp_x", "drift.x", "A*t", "A = { unit = 'deg/h/h', prior = 0.01 }"},
    {"ramp_y", "drift.y", "A*t/3600", "A = { unit = 'deg/h', prior = 0.01 }", 3600.0},
    {"M_z", "drift.z", "A*field_z", "A = { unit = 'deg/h/gauss', prior = 0.01 }"},
    {"D_S_y", "drift.y", "A*f_S", "A = { unit = 'deg/h/g', prior = 2 }"},
    {"D_IO_z", "drift.z", "A*f_I*f_O", "A = { unit = 'deg/h/g^2', prior = 0.1 }"},
    {"W_y", "drift.y", "A*exp(-t/T)",
     "A = { unit = 'deg/h', prior = 0.2 }, T = { unit = 'min', value = 40, grid "
     "= [20, 40, 80, 120] }"},
    {"K2_y", "accelerometer.y", "A*f_y^2", "A = { unit = 'ug/g^2', prior = 50 }"},
    {"enc_s2_inner", "gimbal.inner", "A*sin(2*gimbal_inner)",
     "A = { unit = 'arcsec', prior = 5 }"}};

OwnTermsHeld held(const Twin& twin) {
  return OwnTermsHeld(own_term("twin", twin.acts_on, twin.equation, twin.parameters));
}

/// Base terms and a parameter with what its term needs, known at its default.
FilterSpec filter_with(std::string_view key) {
  FilterSpec filter = base_filter(Coupling::eq6);
  filter.active = TermLibrary::completed(only({"D_F", "eta", "K0", key}));
  return filter;
}

constexpr const char* own = "twin_A";

double size_of(std::string_view key) {
  return 1.5 * TermLibrary::specs[param(key)].prior_si().sigma();
}

Theta truth_with(std::string_view key) {
  Theta theta = make_layout(filter_with(key)).theta;
  theta[param("D_F_x")] = 0.3 * deg_per_h;
  theta[param("eta_z")] = 70.0 * arcsec;
  theta[param(key)] = size_of(key);
  return theta;
}

TEST(OwnTerm, MakesTheRecordingOfTheLibrarysTerm) {
  const Timeline timeline = scene("slew12", CommandLaw::level);
  for (const Twin& twin : twins) {
    SCOPED_TRACE(twin.key);
    const OwnTermsHeld term = held(twin);
    EXPECT_NEAR(size_of(own) / size_of(twin.key), twin.scale, 1e-9);  // rounding of the units
    const auto made = [&](std::string_view key) {
      TruthSpec truth = base_truth(Coupling::eq6);
      truth.active = filter_with(key).active;
      TruthDraw draw = draw_truth(truth, timeline.chains, 3, 0);
      draw.theta = truth_with(key);
      return Simulator(truth, Readout{}).run(timeline, draw, 3, 0);
    };
    const Simulation a = made(twin.key), b = made(own);
    ASSERT_TRUE(a.ode.ok() && b.ode.ok());
    // The integrator of the truth keeps to 1e-9 rad or better; the two sums are rounded otherwise.
    EXPECT_LT(difference(a.measured, b.measured), 1e-10);
    TruthSpec without = base_truth(Coupling::eq6);
    without.active = only({"D_F", "eta", "K0"});
    TruthDraw draw = draw_truth(without, timeline.chains, 3, 0);
    draw.theta = truth_with(own);
    const Simulation c = Simulator(without, Readout{}).run(timeline, draw, 3, 0);
    EXPECT_GT(difference(c.measured, b.measured), 1e-7) << "it does nothing";
  }
}

TEST(OwnTerm, IsEstimatedAsTheLibrarysTermIs) {
  const Timeline timeline = scene("slew12", CommandLaw::level, 1200.0);
  for (const Twin& twin : twins) {
    SCOPED_TRACE(twin.key);
    const OwnTermsHeld term = held(twin);
    TruthSpec truth = base_truth(Coupling::eq6);
    truth.active = filter_with(twin.key).active;
    TruthDraw draw = draw_truth(truth, timeline.chains, 3, 0);
    draw.theta = truth_with(twin.key);
    const Simulation sim = Simulator(truth, Readout{}).run(timeline, draw, 3, 0);
    for (const Estimator& estimator : every_estimator) {
      SCOPED_TRACE(estimator.name);
      const auto estimate = [&](std::string_view key) {
        const FilterSpec filter = filter_with(key);
        return estimator.run(filter, timeline, Readout{}, sim.measured, make_layout(filter).theta);
      };
      const EstimateResult a = estimate(twin.key), b = estimate(own);
      const ParameterEstimate &p = *a.find(param(twin.key)), &q = *b.find(param(own));
      // Two ways of rounding, through normal equations of condition 1e6 at most; where
      // the path is found in lanes two ways of integrating too (PathInLanes has no places for
      // terms), which differ by 2e-4 arcsec in slews: 4e-5 of a reading's noise, at worst in all
      // readings alike.
      const double apart =
          estimator.name == "ekf" ? 1e-6 : 4e-5 * std::sqrt(static_cast<double>(a.measured));
      EXPECT_NEAR(p.value, q.value / twin.scale, apart * p.sigma);
      EXPECT_NEAR(p.sigma * twin.scale / q.sigma, 1.0, 1e-8);
      EXPECT_NEAR(a.statistic, b.statistic, 1e-6 * a.statistic);
      EXPECT_LT(std::abs(p.value - draw.theta[param(twin.key)]), 4.0 * p.sigma);
    }
  }
}

TEST(OwnTerm, HasTheSignatureOfTheLibrarysTermAsACandidate) {
  const Timeline timeline = scene("slew12", CommandLaw::level);
  const FilterSpec nominal = [] {
    FilterSpec filter = base_filter(Coupling::eq6);
    filter.active = only({"D_F", "eta", "K0"});
    return filter;
  }();
  TruthSpec truth = base_truth(Coupling::eq6);
  truth.active = nominal.active;
  const Readout readout;
  const Measurements measured = Simulator(truth, readout).run(timeline, 3, 0).measured;
  const MeasuredTest test{timeline, readout, measured};
  const BatchResult fit = fit_batch(nominal, test, make_layout(nominal).theta);
  const Theta theta = theta_of(nominal, fit);
  for (const Twin& twin : twins) {
    SCOPED_TRACE(twin.key);
    const OwnTermsHeld term = held(twin);
    const inference::CandidateSet set = inference::library_candidates(nominal, theta, timeline);
    const auto problem = inference::linear_problem(nominal, test, fit, set.signatures);
    const auto column = [&](std::string_view key) {
      const auto found =
          std::ranges::find(set.signatures, param(key), &inference::SignatureSpec::param);
      return VecX(problem.extra.col(found - set.signatures.begin()));
    };
    const VecX a = column(twin.key), b = column(own);
    EXPECT_GT(a.norm(), 0.0);
    EXPECT_LT((a - b).norm(), 1e-9 * a.norm());
    EXPECT_TRUE(std::ranges::any_of(set.candidates, [](const inference::Candidate& c) {
      return c.label == "twin" && c.params.size() == 1;
    }));
  }
}

TEST(OwnTerm, SeesAColumnOfTheRecordingAsTheLibrarySeesTheTemperature) {
  const TestPlan plan =
      preset_plan("six", PlanDefaults{1200.0, 60.0, CommandLaw::level, {}}).value();
  Timeline simulated = lay_out(plan, harbin);
  set_environment(simulated, harbin_day(), 1, 0);
  const Simulation sim = Simulator(base_truth(Coupling::eq6), Readout{}).run(simulated, 3, 0);
  Recording recording = make_recording(simulated, sim.measured, Readout{});
  Channel column = *recording.find("temperature");
  column.name = "oven_sensor";
  recording.channels.push_back(column);
  const double mean = simulated.mean[covariate("temperature")];  // what the library takes off
  const OwnTermsHeld held(own_term("twin", "drift.y", "A*(oven_sensor - W)",
                                   "A = { unit = 'deg/h/K', prior = 0.03 }, W = { unit = 'degC', "
                                   "value = " +
                                       fmt::format("{}", mean) + " }"));
  const Timeline timeline = lay_out(recording, plan, harbin);
  ASSERT_TRUE(timeline.carries(covariate("temperature")) &&
              (timeline.carried & further_column(0)) != 0);
  FilterSpec both = base_filter(Coupling::eq6);
  both.active = only({"D_F", "kT_y"}) | params_named("twin");
  for (std::size_t i = 0; i < TermLibrary::specs.size(); ++i)
    both.priors[i] = TermLibrary::specs[i].prior_si();
  const Layout layout = make_layout(both);
  const DriftModel model = both.model();
  const std::vector<Vec3> psi(static_cast<std::size_t>(timeline.chains), Vec3::Zero());
  Theta theta = layout.theta;
  const auto blocks = measurement_equations(
      {timeline, Readout{}, measurements_of(recording, Readout{})}, model, layout, theta,
      integrate_fixed(timeline, model, theta, psi), both.initial_attitude);
  const auto column_of = [&](std::string_view key) {
    return 3 + (std::ranges::find(layout.params, param(key)) - layout.params.begin());
  };
  for (const auto& block : blocks) {
    const VecX a = block.rows.col(column_of("kT_y")), b = block.rows.col(column_of("twin_A"));
    EXPECT_GT(a.norm(), 0.0);
    EXPECT_LT((a - b).norm(), 1e-9 * a.norm());  // the mean is taken off before and after
  }
  // Without the column there is nothing to see.
  recording.channels.pop_back();
  const Timeline poorer = lay_out(recording, plan, harbin);
  EXPECT_FALSE(poorer.carries(TermLibrary::needs(model.terms)));
  EXPECT_THROW(require_covariates(model, poorer), InputError);
}

TEST(OwnTerm, IsProfiledOverItsGridAndKnownWithoutOne) {
  const OwnTermsHeld terms(
      own_term("grids", "drift.x", "A*sin(2*pi*t/P)",
               "A = { unit = 'deg/h', prior = 0.05 }, P = { unit = 'min', value = 40, grid = [20, "
               "40, 80] }") +
      own_term("known", "drift.x", "A*sin(2*pi*t/P)",
               "A = { unit = 'deg/h', prior = 0.05 }, P = { unit = 'min', value = 40 }") +
      own_term("about", "drift.x", "A*sin(2*pi*t/P)",
               "A = { unit = 'deg/h', prior = 0.05 }, P = { unit = 'min', value = 40, prior = 3 "
               "}"));
  const auto settings = [](const char* key) {
    return inference::settings_of(TermLibrary::terms[TermLibrary::find_term(key).value()], {}, {});
  };
  ASSERT_EQ(settings("grids").size(), 3u);
  EXPECT_NEAR(settings("grids")[2][0].second, 80.0 * 60.0, 1e-9);
  ASSERT_EQ(settings("known").size(), 1u);
  EXPECT_TRUE(settings("known")[0].empty());
  ASSERT_EQ(settings("about").size(), 5u);
  EXPECT_NEAR(settings("about")[0][0].second, 34.0 * 60.0, 1e-9);
  FilterSpec filter = base_filter(Coupling::eq5);
  filter.active = params_named("about") | params_named("known");
  for (std::size_t i = 0; i < TermLibrary::specs.size(); ++i)
    filter.priors[i] = TermLibrary::specs[i].prior_si();
  const Layout layout = make_layout(filter);  // A of both, and P of the one that is not known
  EXPECT_EQ(layout.size(), 3u);
  EXPECT_EQ(layout.theta[param("known_P")], 2400.0);
}

TEST(OwnTerm, LeavesTheLibraryAsItWasWhenItGoes) {
  const std::size_t terms = TermLibrary::terms.size(), params = TermLibrary::specs.size();
  {
    const OwnTermsHeld held(own_terms_of_every_kind());
    EXPECT_EQ(TermLibrary::terms.size(), terms + 6);
    EXPECT_EQ(TermLibrary::specs.size(), params + 22);
    EXPECT_EQ(TermLibrary::owner(param("corner_e")).key, "corner");
  }
  EXPECT_EQ(TermLibrary::terms.size(), terms);
  EXPECT_EQ(TermLibrary::specs.size(), params);
  EXPECT_FALSE(TermLibrary::find("corner_e").has_value());
  EXPECT_TRUE(own_terms().terms.empty());
}

}  // namespace
}  // namespace drift::own_terms_test
