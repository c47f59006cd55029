// What the short answer says of parameters far from their priors, whatever the verdict is.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "analysis/report/diagnosis/sections.hpp"
#include "analysis/report/diagnosis/words/sentence.hpp"
#include "tests/analysis/report/diagnosis/diagnosis_fixture.hpp"

namespace drift::far_from_priors_words_test {
namespace {

using namespace diagnosis;
using namespace inference;
using namespace search;
using nlohmann::json;
using test::nominal;

/// A consistent diagnosis whose fit takes one parameter 6.1 sigma from its prior, under a field
/// that nobody measured.
diagnosis::Diagnosis tense(std::size_t param) {
  diagnosis::Diagnosis d;
  d.p_value = 8e-6;
  const double unit = report::unit_of(param);
  ParameterEstimate e{param, 0.0, 0.061 * unit, 0.0004 * unit, 0.0, 0.01 * unit};
  d.remarks = {remark::BeyondPrior{{{e, 6.1, 6e-8}}, 60, {}}, remark::FieldAssumed{}};
  return d;
}

TEST(FarFromPriors, AGimbalThatReadsAConstantTooMuchIsTheFirstThingSaidBesideAnyVerdict) {
  for (diagnosis::Diagnosis d :
       {tense(TermLibrary::find("D_F_y").value()), test::diagnosis(nominal())}) {
    d.remarks.emplace_back(remark::GimbalOffZero{"rec.csv:gimbal_middle: it reads 1 deg too much"});
    const report::InBrief brief = report::diagnosis_in_brief(d);
    const auto said = brief.more.texts();
    ASSERT_FALSE(said.empty());
    EXPECT_EQ(said.front(), "Gimbals: rec.csv:gimbal_middle: it reads 1 deg too much.");
    // A cause that such readings were taken for is nothing to go on with.
    const bool first = brief.next.find("correct the zero, or its offset") != std::string::npos;
    EXPECT_EQ(first, d.verdict != diagnosis::Verdict::consistent) << brief.next;
  }
}

TEST(FarFromPriors, AGyroAtTheEndOfItsRangeIsTheFirstThingSaidBesideAnyVerdict) {
  for (diagnosis::Diagnosis d :
       {tense(TermLibrary::find("D_F_y").value()), test::diagnosis(nominal())}) {
    d.remarks.emplace_back(remark::SaturatedGyro{"gyro_y: in turn 3 (at 45 s) 6 rows read 200"});
    const auto said = report::diagnosis_in_brief(d).more.texts();
    ASSERT_FALSE(said.empty());
    EXPECT_EQ(said.front(), "Range: gyro_y: in turn 3 (at 45 s) 6 rows read 200.");
  }
}

TEST(FarFromPriors, AParameterFarFromItsPriorIsInTheShortAnswerOfAnyVerdict) {
  const auto M_y = TermLibrary::find("M_y").value();
  const auto d = tense(M_y);
  std::string said = report::brief_text(report::diagnosis_in_brief(d), 400);
  EXPECT_NE(said.find("Prior: The fit takes M_y 6.1 prior sigmas from its prior, 0.0610±0.0004 "
                      "deg/h/gauss against 0±0.01 (chance of that for any of 60 parameters: 6e-8): "
                      "the prior is wrong, or M_y takes up something that the model lacks."),
            std::string::npos)
      << said;
  EXPECT_NE(said.find("Field: M_y hangs on a magnetic field that is assumed"), std::string::npos)
      << said;
  EXPECT_EQ(report::brief_text(report::diagnosis_in_brief(d), 80).find(" ..."), std::string::npos);
  const json out = json::parse(report::to_json(d));
  ASSERT_EQ(out["beyond_prior"].size(), 1u);
  EXPECT_EQ(out["beyond_prior"][0]["key"], "M_y");
  EXPECT_NEAR(out["beyond_prior"][0]["value"].get<double>(), 0.061, 1e-12);
  EXPECT_EQ(out["beyond_prior"][0]["prior_sigmas"], 6.1);
  // A drift does not hang on the field; a named cause may.
  diagnosis::Diagnosis other = tense(TermLibrary::find("D_F_y").value());
  said = report::brief_text(report::diagnosis_in_brief(other), 400);
  EXPECT_NE(said.find("D_F_y 6.1 prior sigmas"), std::string::npos) << said;
  EXPECT_EQ(said.find("Field:"), std::string::npos) << said;
  other = test::diagnosis(nominal());
  other.remarks = {remark::FieldAssumed{}};
  EXPECT_EQ(report::brief_text(report::diagnosis_in_brief(other), 400).find("Field:"),
            std::string::npos);
  other.causes[0].term = "magnetic_drift";
  said = report::brief_text(report::diagnosis_in_brief(other), 400);
  EXPECT_NE(said.find("Field: magnetic_drift.y hangs on a magnetic field"), std::string::npos)
      << said;
  EXPECT_TRUE(json::parse(report::to_json(other))["beyond_prior"].empty());
}

TEST(FarFromPriors, WhatIsUnexplainedLeavesRoomForThePriorAndTheNextStepSaysWhatAndWhere) {
  diagnosis::Diagnosis d = test::diagnosis(nominal());
  d.verdict = diagnosis::Verdict::unexplained;
  d.causes.clear();
  d.advice.clear();
  d.has_patch = false;
  d.noise.clear();
  d.proposal = Proposal{};
  d.proposal->acts_on = "drift.y";
  d.proposal->equation = "A*tanh(f_x/S)";
  d.proposal->parameters = {{"own_A", 0, 0.123, 0.019, "deg/h", false},
                            {"own_S", 0, 0.18, 0.024, "g", false}};
  d.remarks = tense(TermLibrary::find("D_F_y").value()).remarks;
  const std::string said = report::brief_text(report::diagnosis_in_brief(d));
  EXPECT_NE(said.find("\nPrior: The fit takes D_F_y 6.1 prior sigmas"), std::string::npos) << said;
  EXPECT_NE(said.find(" more sentence"), std::string::npos) << "what has no room: " << said;
  EXPECT_LE(std::count(said.begin(), said.end(), '\n'), 10) << said;
  EXPECT_EQ(report::diagnosis_in_brief(d).next,
            "Next: look for what acts as drift.y += A*tanh(f_x/S), above all at positions 3 and 1. "
            "Then try the [[term]] of proposal.toml on another recording.");
  // Where no position stands out the strongest window is said, in the time of its recording.
  d.where.positions.clear();
  EXPECT_EQ(report::place_text(d.where), "above all from 1200 s to 1800 s");
  d.where.recordings = {{"a.csv", 0.0, 900.0, 0.0}, {"b.csv", 900.0, 3600.0, 800.0}};
  EXPECT_EQ(report::place_text(d.where), "above all from 400 s to 1000 s of b.csv");
  d.where.windows.clear();
  EXPECT_EQ(report::place_text(d.where), "");
  EXPECT_TRUE(report::diagnosis_in_brief(d).next.starts_with(
      "Next: look for what acts as drift.y += A*tanh(f_x/S). Then try"))
      << report::diagnosis_in_brief(d).next;
}

/// Agreement that costs a parameter its prior is no plain agreement.
TEST(FarFromPriors, TheHeadlineOfAgreementHasTheParametersThatLieFarFromTheirPriors) {
  diagnosis::Diagnosis d = tense(TermLibrary::find("M_y").value());
  report::InBrief brief = report::diagnosis_in_brief(d);
  EXPECT_TRUE(brief.verdict.starts_with(
      "Verdict consistent: The recording agrees with the nominal model, but the fit takes M_y 6.1 "
      "prior sigmas from its prior: a wrong prior, or something that it takes up; beside that no "
      "missing physics is found"))
      << brief.verdict;
  EXPECT_EQ(brief.tone, report::Tone::doubtful);
  auto& beyond = std::get<remark::BeyondPrior>(d.remarks.front());
  beyond.parameters.clear();
  for (const char* key : {"K1_x", "K1_y", "K1_z"}) {
    const auto param = TermLibrary::find(key).value();
    const double unit = report::unit_of(param);
    beyond.parameters.push_back({{param, 0.0, 1e4 * unit, unit, 0.0, 500.0 * unit}, 20.0, 4e-87});
  }
  beyond.scales = identification::CommonScale{1e-2, 3e-4};
  brief = report::diagnosis_in_brief(d);
  EXPECT_NE(brief.verdict.find("but the fit takes K1_x, K1_y, K1_z up to 20.0 prior sigmas from "
                               "their priors: the gravity, or the unit of the accelerometers, is "
                               "wrong; beside that no missing physics is found"),
            std::string::npos)
      << brief.verdict;
  EXPECT_EQ(brief.next,
            "Next: correct site.gravity, or the unit of the accelerometers, and diagnose again.");
  d.remarks.clear();
  brief = report::diagnosis_in_brief(d);
  EXPECT_EQ(brief.verdict.find(", but"), std::string::npos) << brief.verdict;
  EXPECT_EQ(brief.tone, report::Tone::good);
}

TEST(FarFromPriors, WrongPriorsStandBesideTheCauseThatImitatesThem) {
  diagnosis::Diagnosis d = test::diagnosis(nominal());
  d.verdict = diagnosis::Verdict::ambiguous;
  d.remarks = tense(TermLibrary::find("D_F_y").value()).remarks;
  auto& beyond = std::get<remark::BeyondPrior>(d.remarks.front());
  beyond.explains = true;
  d.probabilities.wrong_priors = 0.3;
  report::InBrief brief = report::diagnosis_in_brief(d);
  EXPECT_NE(brief.verdict.find("cannot tell which: either the prior of D_F_y (probability 0.30: "
                               "with more room there nothing is missing), or "),
            std::string::npos)
      << brief.verdict;
  EXPECT_EQ(brief.next,
            "Next: look up the prior of D_F_y before anything is added to the model; where it is "
            "wrong, correct it, or widen it to hold what the fit takes, and diagnose again.");
  beyond.parameters.push_back(beyond.parameters.front());
  brief = report::diagnosis_in_brief(d);
  EXPECT_NE(brief.next.find("where they are wrong, correct them, or widen them"), std::string::npos)
      << brief.next;
  d.causes.clear();
  d.verdict = diagnosis::Verdict::consistent;
  brief = report::diagnosis_in_brief(d);
  EXPECT_NE(brief.verdict.find("agrees with the nominal model but for the priors of D_F_y, D_F_y: "
                               "with more room there nothing is missing."),
            std::string::npos)
      << brief.verdict;
}

}  // namespace
}  // namespace drift::far_from_priors_words_test
