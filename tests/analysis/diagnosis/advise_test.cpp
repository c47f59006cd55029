#include "analysis/diagnosis/advice/advise.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "analysis/diagnosis/advice/alternatives.hpp"
#include "analysis/report/diagnosis/words/advice_words.hpp"
#include "core/base/check.hpp"
#include "core/sim/measurements.hpp"
#include "core/sim/simulate.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::diagnosis::advise_test {
namespace {

using report::advice_in_brief;
using report::advice_text;
using report::advised_labels;
using test::param;

/// Six caged positions with the Earth rate torqued: blind to lambda (physics.md 1.7).
mc::Study level_study() {
  mc::Study s;
  s.path = "study.toml";
  s.site = test::harbin;
  PlanDefaults defaults;
  defaults.mode = CommandLaw::level;
  defaults.dwell = 600.0;
  s.plan = preset_plan("six", defaults).value();
  s.truth = test::base_truth(Coupling::eq5);
  s.filters = {test::base_filter(Coupling::eq5)};
  return s;
}

Recording simulated(const mc::Study& s) {
  const Timeline timeline = lay_out(s.plan, s.site);
  const TruthDraw draw = draw_truth(s.truth, timeline.chains, 1, 0);
  return make_recording(timeline, Simulator(s.truth, s.readout).run(timeline, draw, 1, 0).measured,
                        s.readout);
}

search::Cause cause(std::string_view term, std::string_view key, double value, int set) {
  const auto index = param(key);
  search::Cause c;
  c.term = term;
  c.set = set;
  c.parameters = {{std::string(key), index, value, 0.01,
                   std::string(TermLibrary::specs[index].unit.symbol.view()), false}};
  return c;
}

TEST(Advise, SaysNothingWhereNothingIsToBeSeparated) {
  const mc::Study s = level_study();
  Diagnosis d;
  d.nominal = s.filters.front();
  d.verdict = Verdict::named;
  d.causes = {cause("g2_drift", "D_II_x", 0.1, 0)};
  EXPECT_TRUE(advise(s, {simulated(s)}, d).empty());
  d.verdict = Verdict::consistent;
  d.other_equation_gain = -40.0;
  EXPECT_TRUE(advise(s, {simulated(s)}, d).empty());
}

TEST(Advise, ATestBlindToTheEquationIsGivenPositionsThatTellAndASimulationAgrees) {
  const mc::Study s = level_study();
  Diagnosis d;
  d.nominal = s.filters.front();
  d.other_equation_gain = -0.3;
  const auto advice = advise(s, {simulated(s)}, d);
  ASSERT_EQ(advice.size(), 1u);
  const Advice& a = advice.front();
  EXPECT_LT(a.now_sigma, 5.0) << advice_text(a);
  EXPECT_GT(a.expected_sigma, 5.0) << advice_text(a);
  EXPECT_FALSE(a.plan.empty());
  // Twice the gain of the log likelihood is non-central chi-square: its root is expected_sigma +-
  // 1, and what is not linear in lambda and eta takes its part of a large one.
  EXPECT_NEAR(a.verified_sigma, a.expected_sigma, 4.0 + 0.1 * a.expected_sigma) << advice_text(a);
  EXPECT_NE(advice_text(a).find("eq. (5)"), std::string::npos);
}

TEST(Advise, SeparatesAlternativesThatLookAlike) {
  mc::Study s = level_study();
  FilterSpec& nominal = s.filters.front();
  nominal.active &= ~test::only({"D_II", "D_SS", "D_OO", "D_IO", "D_IS", "D_OS"});
  s.truth.active = nominal.active;
  Diagnosis d;
  d.nominal = nominal;
  d.verdict = Verdict::ambiguous;
  d.causes = {cause("g2_drift", "D_IS_x", 0.3, 0), cause("g2_drift", "D_IO_y", 0.3, 1)};
  const auto advice = advise(s, {simulated(s)}, d);
  ASSERT_EQ(advice.size(), 1u);
  const Advice& a = advice.front();
  EXPECT_EQ(advised_labels(a),
            (std::vector<std::string>{"g2_drift (D_IS_x)", "g2_drift (D_IO_y)"}));
  EXPECT_GT(a.expected_sigma, a.now_sigma);
  EXPECT_GT(a.expected_sigma, 5.0) << advice_text(a);
  EXPECT_NEAR(a.verified_sigma, a.expected_sigma, 4.0 + 0.1 * a.expected_sigma) << advice_text(a);
}

AdviseOptions asking(std::vector<std::string> terms = {}) {
  return {.asked = std::move(terms)};
}

TEST(Advise, OnRequestAnEffectThatThePlanHidesGetsAPositionAndASimulationAgrees) {
  const mc::Study s = level_study();
  Diagnosis d;
  d.nominal = s.filters.front();
  // Heating of a torquer follows the command; on level positions it is a constant that D_F takes.
  const auto advice = advise(s, {simulated(s)}, d, asking({"torquer_heating.x"}));
  ASSERT_FALSE(advice.empty());
  const Advice& a = advice.front();
  EXPECT_LT(a.now_sigma, 1.0) << advice_text(a);
  ASSERT_FALSE(a.plan.empty()) << advice_text(a);
  EXPECT_GT(a.expected_sigma, 8.0) << advice_text(a);
  EXPECT_NEAR(a.verified_sigma, a.expected_sigma, 4.0 + 0.1 * a.expected_sigma) << advice_text(a);
  EXPECT_NE(advice_text(a).find("torquer_heating.x"), std::string::npos) << advice_text(a);
  EXPECT_NE(advice_text(a).find("at one prior sigma"), std::string::npos) << advice_text(a);
  EXPECT_EQ(advice_in_brief(a), advice_text(a));
  Advice many = a;  // a list that is cut off would be another advice
  many.plan.resize(5, a.plan.front());
  EXPECT_NE(advice_in_brief(many).find("Add 5 positions, which --full lists: then"),
            std::string::npos)
      << advice_in_brief(many);
}

TEST(Advise, OnRequestAConsistentRecordingIsToldWhatItsPlanHides) {
  const mc::Study s = level_study();
  Diagnosis d;
  d.nominal = s.filters.front();
  d.other_equation_gain = -0.3;
  const auto advice = advise(s, {simulated(s)}, d, asking());
  ASSERT_GE(advice.size(), 2u);
  const auto seen = advised_labels(advice.front());
  EXPECT_FALSE(advice.front().plan.empty());
  EXPECT_TRUE(std::any_of(seen.begin(), seen.end(),
                          [](const std::string& l) { return l.starts_with("torquer_heating.x"); }));
  EXPECT_NE(std::find(seen.begin(), seen.end(), "eq. (6)"), seen.end());
  // What no position shows is said apart, without a plan.
  EXPECT_TRUE(advice.back().plan.empty());
  EXPECT_NE(advice_text(advice.back()).find("possible additions show"), std::string::npos)
      << advice_text(advice.back());
  Advice nowhere = advice.back();
  nowhere.pool = 0;
  EXPECT_NE(advice_text(nowhere).find("No additions to this plan show"), std::string::npos)
      << advice_text(nowhere);
  for (const std::string& label : advised_labels(advice.back()))
    if (label != "the nominal model") {
      EXPECT_EQ(std::find(seen.begin(), seen.end(), label), seen.end()) << label;
    }
}

TEST(Advise, ANamedCauseThatFollowsTheTemperatureIsNotAskedOfPositions) {
  const mc::Study s = level_study();
  Diagnosis d;
  d.nominal = s.filters.front();
  d.verdict = Verdict::named;
  d.causes = {cause("temperature_drift", "kT_x", 0.1, 0)};
  d.causes.front().confusable_with = {{"drift_ramp", "x", 0.99}};
  const auto advice = advise(s, {simulated(s)}, d, asking());
  ASSERT_EQ(advice.size(), 1u);
  EXPECT_EQ(advice.front().kind, Advice::Kind::varies);
  EXPECT_TRUE(advice.front().plan.empty());
}

TEST(Advise, TwinsAreGivenNoFutilePosition) {
  const mc::Study s = level_study();
  Diagnosis d;
  d.nominal = s.filters.front();
  d.verdict = Verdict::named;
  // C_sag_z a_x^2 on accelerometer y is K_oo_y, its other part K_ip_x, which the nominal model
  // fits.
  d.causes = {cause("accelerometer_cross", "K_oo_y", 60.0, 0)};
  d.causes.front().confusable_with = {{"sag", "z", 1.0}};
  const auto advice = advise(s, {simulated(s)}, d, asking());
  ASSERT_EQ(advice.size(), 1u);
  EXPECT_TRUE(advice.front().plan.empty());
  EXPECT_NE(
      advice_text(advice.front())
          .find(
              "No position of the pool separates accelerometer_cross (K_oo_y) and sag.z (C_sag_z)"),
      std::string::npos)
      << advice_text(advice.front());
  // K_po has no twin: it is not called one.
  d.causes = {cause("accelerometer_cross", "K_po_y", 60.0, 0)};
  d.causes.front().confusable_with = {{"sag", "z", 0.6}};
  for (const Advice& a : advise(s, {simulated(s)}, d, asking()))
    EXPECT_EQ(advice_text(a).find("No position of the pool separates"), std::string::npos)
        << advice_text(a);
}

TEST(Advise, WhoAsksForTwinsIsToldFirstThatNoPositionSeparatesThem) {
  const mc::Study s = level_study();
  Diagnosis d;
  d.nominal = s.filters.front();
  const auto advice = advise(s, {simulated(s)}, d, asking({"sag", "accelerometer_cross"}));
  ASSERT_GE(advice.size(), 2u);
  EXPECT_EQ(advice.front().kind, Advice::Kind::twins) << advice_text(advice.front());
  EXPECT_FALSE(advice[1].plan.empty()) << advice_text(advice[1]);
}

TEST(Advise, TwinsOfAnAmbiguousVerdictAreSaidToBeTwins) {
  const mc::Study s = level_study();
  Diagnosis d;
  d.nominal = s.filters.front();
  d.verdict = Verdict::ambiguous;
  d.causes = {cause("accelerometer_cross", "K_oo_y", 60.0, 0), cause("sag", "C_sag_z", 12.0, 1)};
  const auto advice = advise(s, {simulated(s)}, d);
  ASSERT_EQ(advice.size(), 1u);
  EXPECT_TRUE(advice.front().plan.empty());
  EXPECT_NE(advice_text(advice.front()).find("Another measurement is needed"), std::string::npos)
      << advice_text(advice.front());
}

TEST(Advise, WhatGrowsWithTimeIsAskedAtTheTimeTheAdditionWouldHave) {
  // The simulation runs recorded and added positions in turn; added at time zero a ramp would show
  // less.
  const mc::Study s = level_study();
  Diagnosis d;
  d.nominal = s.filters.front();
  const auto advice =
      advise(s, {simulated(s)}, d,
             {.most = 1, .wanted = 50.0, .asked = std::vector<std::string>{"drift_ramp.x"}});
  ASSERT_FALSE(advice.empty());
  const Advice& a = advice.front();
  ASSERT_FALSE(a.plan.empty()) << advice_text(a);
  EXPECT_NEAR(a.verified_sigma, a.expected_sigma, 2.0) << advice_text(a);  // two of its sigmas
}

TEST(Advise, OfSeveralThatWereAskedForEachIsSaid) {
  const mc::Study s = level_study();
  Diagnosis d;
  d.nominal = s.filters.front();
  std::vector<std::string> asked{"torquer_heating.x", "drift_ramp.y"};
  Advice many = advise(s, {simulated(s)}, d, asking(asked)).at(0);  // as a summary of pairs
  EXPECT_EQ(many.names, asked);
  many.kind = Advice::Kind::add;
  many.alternatives.resize(4), many.plan.resize(5, s.plan.positions.front());
  many.pairs.assign({{{0, 1}, 1.0, 9.0}, {{2, 3}, 2.0, 9.0}});
  many.sizes = Sizes::one_prior_sigma;
  const std::string said = advice_in_brief(many);
  EXPECT_NE(said.find("torquer_heating.x, drift_ramp.y, at one prior sigma: of "), said.npos)
      << said;
}

TEST(Advise, TermsThatCannotBeAskedForAreSaidAllAtOnce) {
  const mc::Study s = level_study();
  Diagnosis d;
  d.nominal = s.filters.front();
  try {
    advise(s, {simulated(s)}, d,
           asking({"sagg", "eta_x", "magnetic_drift", "temperature_drift", "sag"}));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    // The field of magnetic_drift is that of a dipole where nobody has measured it.
    ASSERT_EQ(error.messages().size(), 3u);
    EXPECT_NE(error.messages()[0].find("Did you mean 'sag'"), std::string::npos);
    EXPECT_NE(error.messages()[1].find("eta_x"), std::string::npos);
    EXPECT_NE(error.messages()[2].find("temperature"), std::string::npos);
  }
}

TEST(Advise, OnRequestAnUnexplainedMisfitIsToldWhichPositionToRepeat) {
  const mc::Study s = level_study();
  Diagnosis d;
  d.nominal = s.filters.front();
  d.verdict = Verdict::unexplained;
  EXPECT_TRUE(advise(s, {simulated(s)}, d).empty());
  Share share;
  share.position = 3;
  d.where.positions = {share};
  const auto advice = advise(s, {simulated(s)}, d, asking());
  ASSERT_EQ(advice.size(), 1u);
  EXPECT_NE(advice_text(advice.front()).find("Repeat position 3"), std::string::npos);
}

TEST(Advise, WhatFollowsTheTemperatureIsNotAskedOfPositions) {
  // Positions are planned at one temperature; an alternative that follows it must not cost the
  // advice on others.
  Diagnosis d;
  d.verdict = Verdict::ambiguous;
  for (const char* term : {"temperature_drift", "drift_ramp", "magnetic_drift"}) {
    search::Cause c;
    c.term = term;
    c.axis = "z";
    c.set = static_cast<int>(d.causes.size());
    d.causes.push_back(c);
  }
  const Question q = open_question(d);
  EXPECT_EQ(q.alternatives.size(), 2u);
  for (const Alternative& a : q.alternatives)
    for (const search::Cause& c : a.causes) EXPECT_NE(c.term, "temperature_drift");
  d.causes.resize(1);
  EXPECT_TRUE(open_question(d).empty());
}

}  // namespace
}  // namespace drift::diagnosis::advise_test
