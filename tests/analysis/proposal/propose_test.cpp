// What nothing known explains is proposed as a term, and the term does what is said of it.
#include "analysis/proposal/propose.hpp"

#include <gtest/gtest.h>

#include <map>

#include "analysis/diagnosis/diagnose.hpp"
#include "analysis/report/diagnosis/words/form_words.hpp"
#include "analysis/report/diagnosis/words/sentence.hpp"
#include "tests/support/model_builders.hpp"
#include "tests/support/own_terms.hpp"

namespace drift::proposal::propose_test {
namespace {

using namespace drift::test;

/// A test of a truth that holds an effect which the library does not have.
struct Hiding {
  Timeline timeline;
  Readout readout;
  Measurements measured;
  /// own: its text as a term "hidden", with the values of its parameters [SI].
  Hiding(Timeline plan, const std::string& own, const std::map<std::string, double>& values)
      : timeline(std::move(plan)) {
    const OwnTermsHeld hidden(own);
    TruthSpec truth = base_truth(Coupling::eq5);
    truth.active |= params_named("hidden");
    TruthDraw draw = draw_truth(truth, timeline.chains, 11, 1);
    for (const auto& [key, value] : values) draw.theta[param(key)] = value;
    measured = Simulator(truth, readout).run(timeline, draw, 11, 1).measured;
  }
  diagnosis::Diagnosis diagnose(diagnosis::Proposing proposing) const {
    diagnosis::DiagnoseOptions options;
    options.proposing = proposing;
    options.whiteness_draws = 0;
    options.signals = diagnosis::Signals::left_out;
    return diagnosis::diagnose(base_filter(Coupling::eq5), {timeline, readout, measured}, {}, {},
                               options);
  }
};

TEST(Diagnose, AFormIsProposedThatNamesTheEffectOnceItIsInTheStudy) {
  // Gyro y oscillates in some attitudes.
  const Hiding test(
      preset_timeline("twelve", CommandLaw::free, 1800.0, 90.0),
      own_term("hidden", "drift.y", "A*sin(2*pi*t/P)*step(abs(f_z) - 0.6)",
               "A = { unit = 'deg/h', prior = 0.1 }, P = { unit = 'min', value = 41 }"),
      {{"hidden_A", 0.06 * deg_per_h}, {"hidden_P", 41.0 * 60.0}});
  const OwnTermSet before = own_terms();
  const auto first = test.diagnose(diagnosis::Proposing::where_unexplained);
  EXPECT_TRUE(own_terms() == before);  // the library is as it was
  ASSERT_EQ(first.verdict, diagnosis::Verdict::unexplained) << report::sentence(first);
  ASSERT_TRUE(first.proposal);
  const diagnosis::Proposal& p = *first.proposal;
  EXPECT_EQ(p.acts_on, "drift.y") << p.text;
  EXPECT_GT(p.held_out_gain, inference::WeighLimits::held_out);
  EXPECT_LT(p.chi2_per_dof_after, p.chi2_per_dof_before);
  EXPECT_LT(p.p_value, inference::SearchLimits::alpha);
  EXPECT_NE(report::form_sentence(p).find("not a cause"), std::string::npos);
  for (const search::CauseParameter& parameter : p.parameters)
    if (parameter.unit == "min") {
      EXPECT_NEAR(parameter.value, 41.0, 4.0 * parameter.sigma);
    }

  const OwnTermsHeld held(p.text);
  const auto second = test.diagnose(diagnosis::Proposing::left_out);
  ASSERT_EQ(second.verdict, diagnosis::Verdict::named) << report::sentence(second) << p.text;
  EXPECT_EQ(second.causes.front().term, "form_1");
}

// Weak or strong: what an edge that is a minute off leaves of a strong one would stand against it.
TEST(Diagnose, AWindowIsProposedWithTheRowsThatItBeganAndEndedIn) {
  const Hiding test(
      preset_timeline("twentyfour", CommandLaw::free, 1800.0, 60.0),
      own_term("hidden", "drift.x", "A*step(t - C)*step(F - t)",
               "A = { unit = 'deg/h', prior = 0.05 }, C = { unit = 'min', value = "
               "251 }, F = { unit = 'min', value = 266 }"),
      {{"hidden_A", 0.1 * deg_per_h}, {"hidden_C", 251.0 * 60.0}, {"hidden_F", 266.0 * 60.0}});
  const auto found = test.diagnose(diagnosis::Proposing::where_unexplained);
  ASSERT_EQ(found.verdict, diagnosis::Verdict::unexplained) << report::sentence(found);
  ASSERT_TRUE(found.proposal);
  EXPECT_EQ(found.proposal->acts_on, "drift.x");
  ASSERT_EQ(found.proposal->parameters.size(), 3u);
  EXPECT_NEAR(found.proposal->parameters[0].value, 0.1, 4.0 * found.proposal->parameters[0].sigma);
  EXPECT_NEAR(found.proposal->parameters[1].value, 251.0, 1e-6);
  EXPECT_NEAR(found.proposal->parameters[2].value, 266.0, 1e-6);
}

TEST(Diagnose, WhatATermImitatesWithMoreParametersIsNotNamedForIt) {
  const Hiding test(
      preset_timeline("twentyfour", CommandLaw::free, 1800.0, 90.0),
      own_term("hidden", "drift.z", "A*f_y*f_z*f_z", "A = { unit = 'deg/h/g^3', prior = 0.1 }"),
      {{"hidden_A", 0.25 * deg_per_h}});
  const auto found = test.diagnose(diagnosis::Proposing::where_unexplained);
  ASSERT_EQ(found.verdict, diagnosis::Verdict::unexplained) << report::sentence(found);
  EXPECT_GT(found.probabilities.outside, inference::SearchLimits::credible);
  ASSERT_TRUE(found.proposal);
  EXPECT_EQ(found.proposal->acts_on, "drift.z");
  EXPECT_EQ(found.proposal->equation, "A*f_y*f_z*f_z");
}

}  // namespace
}  // namespace drift::proposal::propose_test
