// The verdict against the probabilities where nothing is significant.
#include "analysis/diagnosis/judge.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/report/diagnosis/report.hpp"
#include "analysis/report/diagnosis/words/sentence.hpp"
#include "tests/support/white_problem.hpp"

namespace drift::diagnosis::judge_test {
namespace {

/// Rows of the noise that is declared, and one parameter.
search::Fitted of_white_noise() {
  VecX r0 = VecX::Ones(100);
  for (Eigen::Index k = 0; k < r0.size(); k += 2) r0[k] = -1.0;
  search::Fitted f;
  f.problem = test::white_problem(MatX::Ones(100, 1), MatX::Zero(100, 0), r0);
  f.projector.emplace(f.problem, f.noise.model);
  return f;
}

/// Nothing significant; the rest of the probability is of an effect.
Judged judged(double consistent, double noise_only, double wrong_priors = 0.0) {
  search::Posterior posterior;
  posterior.consistent = consistent;
  posterior.noise_only = noise_only;
  posterior.wrong_priors = wrong_priors;
  posterior.named = {{{{0, 0}}, 1.0 - consistent - noise_only - wrong_priors}};
  return judge(of_white_noise(), search::Search{}, posterior, {}, {}, NamedBy::held_out);
}

TEST(Judge, WhatIsCrediblyMissingIsNotConsistentThoughNothingIsSignificant) {
  EXPECT_EQ(judged(0.96, 0.0).verdict, Verdict::consistent);
  EXPECT_EQ(judged(0.0, 0.96).verdict, Verdict::consistent);
  EXPECT_EQ(judged(0.0, 0.06).verdict, Verdict::consistent);
  EXPECT_EQ(judged(0.03, 0.03).verdict, Verdict::consistent);
  EXPECT_EQ(judged(0.0, 0.03, 0.03).verdict, Verdict::consistent) << "but for the priors";
  const Judged open = judged(0.0, 0.02);
  EXPECT_EQ(open.verdict, Verdict::ambiguous);
  EXPECT_FALSE(open.names_causes());
  ASSERT_TRUE(open.likelier_missing.has_value());
  EXPECT_EQ(open.likelier_missing->nothing, 0.02);
  EXPECT_EQ(judged(0.0, 0.04).verdict, Verdict::ambiguous);
  EXPECT_FALSE(judged(0.0, 0.06).likelier_missing.has_value());
}

TEST(Judge, OfWhatIsNotSignificantTheAnswerSaysBothAndTheirProbabilities) {
  Diagnosis d;
  d.of_case = true;
  d.verdict = Verdict::ambiguous;
  d.p_value = 0.046;
  d.probabilities = {0.0, 0.23, 0.01, {}, 0.0, 0.0};
  d.probabilities.named = {{{{"temperature_drift", "x", "temperature_drift.x"}}, 0.71},
                           {{{"temperature_drift", "", "temperature_drift"}}, 0.05}};
  inference::NoiseFinding walk;
  walk.component = "drift_random_walk";
  walk.significant = true;
  walk.factor = walk.factor_sigma = std::nan("");
  walk.value = 347.0;
  walk.unit = "deg/h/sqrt(h)";
  d.noise = {walk};
  d.remarks = {remark::LikelierMissing{0.23}};
  const std::string said = report::sentence(d);
  EXPECT_EQ(
      said.find("Something may be missing from the nominal model: noise alone shows as much with a "
                "chance of 0.046, but that nothing is missing has a probability of 0.23 only. An "
                "effect of the library has 0.76 (the likeliest, "),
      0u)
      << said;
  EXPECT_NE(said.find("(temperature_drift.x): 0.71), something that no term describes 0.01"),
            std::string::npos)
      << said;
  EXPECT_NE(said.find("Or else: The noise is not as the rows scatter"), std::string::npos) << said;
  EXPECT_EQ(said.find("no missing physics"), std::string::npos) << said;
  const report::InBrief brief = report::diagnosis_in_brief(d);
  EXPECT_EQ(brief.verdict.find("Verdict ambiguous: Something may be missing"), 0u);
  EXPECT_NE(brief.next.find("a second recording"), std::string::npos) << brief.next;
}

}  // namespace
}  // namespace drift::diagnosis::judge_test
