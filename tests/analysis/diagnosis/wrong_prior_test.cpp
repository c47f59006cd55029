// Nothing is missing but a right prior: it is told so, with the value that the test has.
#include <gtest/gtest.h>

#include "analysis/diagnosis/diagnose.hpp"
#include "analysis/inference/thresholds.hpp"
#include "analysis/report/diagnosis/report.hpp"
#include "tests/support/six_positions.hpp"

namespace drift::diagnosis::wrong_prior_test {
namespace {

using namespace drift::test;

/// A diagnosis of a unit of the nominal model, of one of whose parameters so much more was believed
/// than it has.
struct WrongBelief {
  std::size_t i;
  double truth = 0.0, sigma = 0.0;
  Diagnosis d;

  WrongBelief(const char* key, double off, double believed_sigma) : i(param(key)) {
    const double unit = TermLibrary::specs[i].unit.to_si;
    const Timeline timeline = preset_timeline("twelve", CommandLaw::free, 1800.0, 300.0);
    const TruthSpec unit_of_test = base_truth(Coupling::eq6);
    const Readout readout;
    const TruthDraw draw = draw_truth(unit_of_test, timeline.chains, 11, 0);
    truth = draw.theta[static_cast<Eigen::Index>(i)];
    sigma = believed_sigma * unit;
    FilterSpec filter = base_filter(Coupling::eq6);
    filter.priors[i] = normal(truth + off * unit, sigma);
    const Measurements measured =
        Simulator(unit_of_test, readout).run(timeline, draw, 11, 0).measured;
    DiagnoseOptions options;
    options.folds = FoldMethod::linear;
    options.whiteness_draws = 0;
    d = diagnose(filter, {timeline, readout, measured}, {}, {}, options);
  }
};

void expect_told(const WrongBelief& w, const std::string& key) {
  const std::string said = report::diagnosis_in_brief(w.d).verdict;
  const auto* beyond = remark_in<remark::BeyondPrior>(w.d);
  ASSERT_NE(beyond, nullptr) << said;
  EXPECT_TRUE(beyond->explains) << said;
  ASSERT_EQ(beyond->parameters.size(), 1u) << said;
  const ParameterEstimate& e = beyond->parameters.front().estimate;
  EXPECT_EQ(e.param, w.i);
  EXPECT_LT(std::abs(e.value - w.truth), 4.0 * e.sigma) << "one of a few: 6e-5 each";
  EXPECT_NE(said.find("the prior of " + key + ": with more room"), std::string::npos) << said;
  EXPECT_FALSE(w.d.proposal) << "of what is explained no form is offered";
  EXPECT_NE(report::diagnosis_in_brief(w.d).next.find("correct the prior of " + key),
            std::string::npos);
}

TEST(WrongPrior, OfAnAccelerometerIsToldWhereAnEffectCouldTakeItUp) {
  for (const double off : {300.0, -5000.0}) {  // ug: 15 and 250 times as sure as it is right
    SCOPED_TRACE(off);
    expect_told(WrongBelief("K0_x", off, 20.0), "K0_x");
  }
}

TEST(WrongPrior, ThatHoldsItsParameterBackIsToldAsWell) {
  expect_told(WrongBelief("K1_x", 5000.0, 20.0), "K1_x");  // ppm
}

TEST(WrongPrior, OfAGyroIsToldWhereTheTestIsFitted) {
  const WrongBelief w("D_I_z", -4.5, 0.1);
  EXPECT_EQ(w.d.verdict, Verdict::consistent);
  expect_told(w, "D_I_z");
}

TEST(WrongPrior, IsNoneWhereAllAreRight) {
  const WrongBelief w("K0_x", 10.0, 20.0);
  EXPECT_EQ(w.d.verdict, Verdict::consistent);
  EXPECT_EQ(remark_in<remark::BeyondPrior>(w.d), nullptr);
}

/// A test that holds its platform level, by commands of which those about `axis` were written down
/// with another weight of a pulse: its torquer's scale factor is off by ten prior sigmas.
mc::Study level_study(const char* preset) {
  PlanDefaults defaults;
  defaults.dwell = 3600.0;
  defaults.sample = 60.0;
  defaults.mode = CommandLaw::level;
  mc::Study study = six_study(defaults);
  study.plan = preset_plan(preset, defaults).value();
  study.readout.accelerometer_noise = 5e-6 * unit::g.to_si;
  study.readout.gimbal_noise = 5.0 * unit::arcsec.to_si;
  return study;
}
Diagnosis with_pulses_of(double weight, std::string_view command, const mc::Study& study,
                         std::uint64_t seed) {
  const Timeline timeline = lay_out(study.plan, study.site);
  const TruthDraw draw = draw_truth(study.truth, timeline.chains, seed, 0);
  Recording recording = make_recording(
      timeline, Simulator(study.truth, study.readout).run(timeline, draw, seed, 0).measured,
      study.readout);
  for (double& value : channel(recording, command)) value *= weight;
  DiagnoseOptions options;
  options.folds = FoldMethod::linear;
  options.starts = 1;
  options.whiteness_draws = 0;
  return diagnose(study, {recording}, options);
}

double sum_of(const Probabilities& p) {
  double sum = p.consistent + p.noise_only + p.outside;
  for (const auto& e : p.named) sum += e.probability;
  return sum;
}

TEST(WrongPrior, IsARivalOfTheEffectThatImitatesIt) {
  // A restraint of the float takes most of that up, at a size that is usual.
  mc::Study study = level_study("six");
  study.truth.active &= ~only({"D_II", "D_OO", "D_SS", "D_IO", "D_IS", "D_OS"});
  study.filters.front().active = study.truth.active;
  const Diagnosis d = with_pulses_of(1.01, "cmd_z", study, 3);
  const std::string said = report::diagnosis_in_brief(d).verdict;
  EXPECT_NE(d.verdict, Verdict::named) << said;
  EXPECT_NE(said.find("the prior of s_z"), std::string::npos) << said;
  EXPECT_GT(d.probabilities.wrong_priors, 0.05);
  EXPECT_NEAR(sum_of(d.probabilities), 1.0, 1e-12);
  EXPECT_NE(report::diagnosis_in_brief(d).next.find("the prior of s_z"), std::string::npos);
}

TEST(WrongPrior, IsARivalOfEffectsThatLeaveItsParameterOffAndOfNone) {
  for (const char* preset : {"twelve", "twentyfour"}) {
    const Diagnosis d = with_pulses_of(1.01, "cmd_z", level_study(preset), 1);
    const std::string said = report::diagnosis_in_brief(d).verdict;
    EXPECT_EQ(d.verdict, Verdict::consistent) << said;
    EXPECT_GT(d.probabilities.wrong_priors, inference::SearchLimits::credible) << preset;
    EXPECT_NE(said.find("but for the prior of s_z"), std::string::npos) << said;
  }
}

/// A test of six hours whose unit has an effect that the nominal model lacks, and one of whose
/// parameters was believed to be at zero, so sure.
Diagnosis with_belief_and_effect(const char* believed, double sigma, double value,
                                 const char* effect, double size) {
  mc::Study study = six_study(3600.0, 60.0);
  study.readout.accelerometer_noise = 5e-6 * unit::g.to_si;
  study.readout.gimbal_noise = 5.0 * unit::arcsec.to_si;
  const auto si = [](const char* key) { return TermLibrary::specs[param(key)].unit.to_si; };
  study.filters.front().priors[param(believed)] = normal(0.0, sigma * si(believed));
  const Timeline timeline = lay_out(study.plan, study.site);
  TruthSpec truth = study.truth;
  truth.active |= only({effect});
  TruthDraw draw = draw_truth(study.truth, timeline.chains, 108, 0);
  draw.theta[param(believed)] = value * si(believed);
  draw.theta[param(effect)] = size * si(effect);
  const Recording recording =
      make_recording(timeline, Simulator(truth, study.readout).run(timeline, draw, 108, 0).measured,
                     study.readout);
  DiagnoseOptions options;
  options.folds = FoldMethod::linear;
  options.starts = 1;
  options.whiteness_draws = 0;
  return diagnose(study, {recording}, options);
}

/// Either is known beside the other: where priors were all taken for right a second effect had
/// stood for the wrong one, or nothing had been found.
TEST(WrongPrior, BesideAnEffectIsToldAndTheEffectHasItsName) {
  struct Case {
    const char* believed;
    double sigma, value;
    const char *effect, *term;
    double size;
  };
  for (const Case& c : {Case{"D_S_y", 0.04, 1.2, "nonorth_1", "gimbal_nonorthogonality", -40.0},
                        Case{"K0_x", 20.0, 300.0, "nonorth_2", "gimbal_nonorthogonality", 40.0}}) {
    SCOPED_TRACE(c.effect);
    const Diagnosis d = with_belief_and_effect(c.believed, c.sigma, c.value, c.effect, c.size);
    const std::string said = report::diagnosis_in_brief(d).verdict;
    EXPECT_EQ(d.verdict, Verdict::named) << said;
    ASSERT_FALSE(d.causes.empty()) << said;
    for (const search::Cause& cause : d.causes) EXPECT_EQ(cause.term, c.term) << said;
    EXPECT_NEAR(sum_of(d.probabilities), 1.0, 1e-12);
    EXPECT_LT(d.probabilities.other_priors, 0.05);
    const auto* beyond = remark_in<remark::BeyondPrior>(d);
    ASSERT_NE(beyond, nullptr) << said;
    EXPECT_TRUE(beyond->taken);
    EXPECT_FALSE(beyond->explains);
    ASSERT_EQ(beyond->parameters.size(), 1u) << said;
    EXPECT_EQ(beyond->parameters.front().estimate.param, param(c.believed));
    EXPECT_EQ(d.patched.priors[param(c.believed)].mean(), 0.0);
    EXPECT_NEAR(d.patched.priors[param(c.believed)].sigma() / (c.value / c.sigma) /
                    d.nominal.priors[param(c.believed)].sigma(),
                1.0, 0.1)
        << "as wide as it lies off";
    EXPECT_NE(report::diagnosis_in_brief(d).next.find("and room in the prior of " +
                                                      std::string(c.believed)),
              std::string::npos);
  }
}

}  // namespace
}  // namespace drift::diagnosis::wrong_prior_test
