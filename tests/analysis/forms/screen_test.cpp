#include "analysis/forms/screen.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/forms/term_text.hpp"
#include "analysis/inference/thresholds.hpp"
#include "analysis/search/fitted.hpp"
#include "tests/support/model_builders.hpp"
#include "tests/support/own_terms.hpp"

namespace drift::forms::screen_test {
namespace {

using namespace drift::test;

/// A test with something added to the rate of the platform, and the nominal fit to it.
struct Tested {
  Timeline timeline = preset_timeline("twelve", CommandLaw::free, 1200.0, 120.0);
  Readout readout;
  FilterSpec filter = base_filter(Coupling::eq5);
  Measurements measured;
  BatchResult fit;
  inference::NoiseEstimate noise;

  explicit Tested(std::uint64_t seed, const Mat3X& disturbance = {}) {
    const TruthSpec truth = base_truth(Coupling::eq5);
    Simulator simulator(truth, readout);
    simulator.disturb(disturbance);
    measured =
        simulator.run(timeline, draw_truth(truth, timeline.chains, seed, 1), seed, 1).measured;
    fit = fit_batch(filter, {timeline, readout, measured}, make_layout(filter).theta);
    noise.model = search::declared_noise(filter);
  }
  Screening screened(std::size_t keep) const {
    const inference::LinearProblem problem =
        inference::linear_problem(filter, {timeline, readout, measured}, fit, {});
    return screen_forms(problem, timeline, inference::Projector(problem, noise.model), keep);
  }
};

/// A drift of gyro y that follows the specific force along x and fades [rad/s].
Mat3X fading_drift(double size) {
  const Timeline timeline = preset_timeline("twelve", CommandLaw::free, 1200.0, 120.0);
  const Instants at = instants_of(timeline);
  Mat3X out = Mat3X::Zero(3, at.size());
  for (Eigen::Index i = 0; i < at.size(); ++i)
    out(1, i) = -size * at.force[0][i] *
                std::exp(-at.t[i] / 7200.0);  // the platform follows with minus the drift
  return out;
}

TEST(ScreenForms, NoiseAloneGivesNoneAsMuchButOnceInFiftyTests) {
  std::size_t alarms = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Screening s = Tested(seed).screened(3);
    ASSERT_FALSE(s.best.empty());
    alarms += s.best.front().log_p < std::log(inference::SearchLimits::alpha);
    EXPECT_GT(s.forms, 10000u);
  }
  EXPECT_LE(alarms, 2u);  // of 20 at 0.02 each at most: above 2 once in 140
}

TEST(ScreenForms, AFormScoresAsTheCandidateOfItsTermAndHasItsSizeAndSign) {
  const Tested tested(5, fading_drift(0.1 * deg_per_h));
  const Screening s = tested.screened(4);
  ASSERT_FALSE(s.best.empty());
  EXPECT_LT(s.best.front().log_p, std::log(1e-6));
  const Instants at = instants_of(tested.timeline);
  std::string text;
  for (std::size_t k = 0; k < s.best.size(); ++k)
    text += term_text(s.best[k].form, at, "form_" + std::to_string(k + 1), 1e-6);
  const OwnTermsHeld held(text);
  const search::Fitted e = search::examine(
      tested.filter, {tested.timeline, tested.readout, tested.measured}, tested.fit, tested.noise);
  for (std::size_t k = 0; k < s.best.size(); ++k) {
    const std::string key = "form_" + std::to_string(k + 1);
    double T = 0.0;
    for (std::size_t c = 0; c < e.scores.size(); ++c)
      if (e.set.candidates[c].term == key) T = std::max(T, e.scores[c].T);
    // The way from an input to the rows is first order in the attitude (IntervalDrive: a few
    // percent), bins are means of a few rows.
    EXPECT_NEAR(std::sqrt(T), std::sqrt(s.best[k].T), 0.1 * std::sqrt(T)) << text;
  }
}

TEST(ScreenForms, WhatWasHiddenIsAmongTheBest) {
  const Screening s = Tested(5, fading_drift(0.1 * deg_per_h)).screened(6);
  const bool found = std::ranges::any_of(s.best, [](const ScreenedForm& f) {
    return f.form.place == OwnTarget{OwnSlot::drift, 1} &&
           f.form.where.kind == AttitudePart::Kind::product &&
           f.form.when.kind == TimePart::Kind::decay &&
           std::abs(f.form.when.setting - 7200.0) < 4.0 * f.form.when.sigma;
  });
  EXPECT_TRUE(found);
}

}  // namespace
}  // namespace drift::forms::screen_test
