// The short answer's next step: positions that separate some causes, and those that none separates.
#include "analysis/report/diagnosis/words/advice_words.hpp"

#include <gtest/gtest.h>

#include "analysis/report/diagnosis/report.hpp"

namespace drift::advice_words_test {
namespace {

using diagnosis::Advice;
using diagnosis::Alternative;
using diagnosis::Sizes;

Alternative found(const char* term, const char* axis) {
  search::Cause cause;
  cause.term = term;
  cause.axis = axis;
  return {Alternative::Kind::causes, {cause}, {}, {}};
}

/// Of three causes two leave one trace; a position tells the third from both.
std::vector<Advice> of_three() {
  Advice add, rest;
  add.alternatives = {found("sag", "z"), found("accelerometer_cross", "y"),
                      found("encoder_harmonics", "outer")};
  add.pairs = {{{1, 2}, 3.4, 12.5}, {{0, 2}, 3.6, 12.6}};
  add.plan.resize(1);
  add.asked = 3;
  add.wanted = 8.0;
  add.now_sigma = 3.4;
  add.expected_sigma = 12.5;
  rest.kind = Advice::Kind::twins;
  rest.alternatives = add.alternatives;
  rest.pairs = {{{0, 1}, 2.6, 2.6}, {{1, 0}, 2.6, 2.6}};
  return {add, rest};
}

TEST(AdviceWords, AShortAnswerSaysWhichCausesNoPositionSeparates) {
  const std::vector<Advice> advice = of_three();
  const std::string said = report::advice_in_brief(advice);
  EXPECT_TRUE(said.starts_with(
      "Of 3 pairs, 2 are less than 8 sigma apart on this plan and more on another; no position "
      "separates sag.z and accelerometer_cross.y. Add "))
      << said;
  EXPECT_NE(said.find(": then 2 of them come above 8 sigma. "), said.npos) << said;
  diagnosis::Diagnosis d;
  d.verdict = diagnosis::Verdict::unexplained;
  d.advice = advice;
  EXPECT_EQ(report::diagnosis_in_brief(d).next, "Next: " + said);
}

TEST(AdviceWords, AShortAnswerSaysWhatAllAdditionsLeaveTooClose) {
  std::vector<Advice> advice = of_three();
  advice[1].kind = Advice::Kind::hidden;
  EXPECT_NE(report::advice_in_brief(advice).find(
                "; no addition separates sag.z from accelerometer_cross.y. Add "),
            std::string::npos)
      << report::advice_in_brief(advice);
  advice[0] = advice[1];
  advice[0].kind = Advice::Kind::twins;
  EXPECT_TRUE(report::advice_in_brief(advice).ends_with(
      " No addition separates sag.z from accelerometer_cross.y."))
      << report::advice_in_brief(advice);
}

/// It stands before what is to be added, since a terminal shows four lines.
TEST(AdviceWords, ATerminalShowsWhichCausesNoPositionSeparates) {
  std::vector<Advice> advice = of_three();
  advice[0].plan[0].axes = "x=S y=W z=D";
  report::InBrief brief;
  brief.verdict = "Verdict ambiguous.";
  brief.next = "Next: " + report::advice_in_brief(advice);
  const std::string shown = report::brief_text(brief);
  EXPECT_NE(shown.find("no position"), shown.npos) << shown;
  EXPECT_NE(shown.find("come above"), shown.npos) << shown;
}

TEST(AdviceWords, EffectsThatWereNotFoundStandInTheFullAnswer) {
  std::vector<Advice> advice = of_three();
  for (const auto kind : {Advice::Kind::twins, Advice::Kind::hidden}) {
    advice[1].kind = kind;
    advice[1].sizes = Sizes::one_prior_sigma;
    EXPECT_EQ(report::advice_in_brief(advice), report::advice_in_brief(advice.front()));
  }
  EXPECT_EQ(report::advice_in_brief(std::vector<Advice>{advice[1]}),
            report::advice_text(advice[1]));
}

}  // namespace
}  // namespace drift::advice_words_test
