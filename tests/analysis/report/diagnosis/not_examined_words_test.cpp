#include "analysis/report/diagnosis/words/not_examined_words.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "analysis/report/diagnosis/report.hpp"
#include "analysis/report/diagnosis/words/sentence.hpp"
#include "tests/support/own_terms.hpp"

namespace drift::not_examined_words_test {
namespace {

using diagnosis::NotExamined;

/// Of a column that was read and is not used it is not said that nobody recorded it.
TEST(NotExaminedWords, SayWhyAColumnThatWasReadIsNotUsed) {
  NotExamined n{.term = "temperature_drift",
                .why = NotExamined::Why::no_covariate,
                .instead = "temperature lacks readings in so many rows that it is not used",
                .missing = covariate("temperature").set()};
  EXPECT_EQ(report::reason_in_words(n, {}), "it follows the temperature: " + n.instead);
  EXPECT_EQ(report::not_examined_sentences({n}, {}).at(0),
            "Not examined: temperature_drift: " + n.instead);
  EXPECT_EQ(report::followed_text({n}, {}), "");
  n.missing = further_column(0);
  EXPECT_EQ(report::reason_in_words(n, {}), "it follows a column: " + n.instead);
  n.instead.clear();
  EXPECT_EQ(report::reason_in_words(n, {}),
            "it follows a covariate that the recording does not have");
}

/// A term that the study brings is asked for by it: the short answer says that it was left out.
TEST(NotExaminedWords, AShortAnswerSaysThatATermOfTheStudyWasLeftOut) {
  const test::OwnTermsHeld held(
      test::own_term("mine", "drift.y", "B*oil", "B = { unit = 'deg/h', prior = 0.01 }"));
  diagnosis::Diagnosis d;
  d.verdict = diagnosis::Verdict::unexplained;
  d.where.recordings = {{"a.csv", 0.0, 900.0, 0.0}, {"b.csv", 900.0, 3600.0, 800.0}};
  d.not_examined = {{.term = "mine", .missing = further_column(0), .lacking = {1}}};
  const report::InBrief brief = report::diagnosis_in_brief(d);
  const auto said = brief.more.texts();
  EXPECT_NE(std::ranges::find(
                said, "Not examined: mine, a term of the study: b.csv lacks the column oil."),
            said.end())
      << testing::PrintToString(said);
  EXPECT_EQ(brief.next,
            "Next: give b.csv the column oil, or leave it out, and diagnose again: mine, a term of "
            "the study, was not examined.");
  EXPECT_EQ(brief.verdict.find("Not examined"), std::string::npos) << "said once";
  // Nothing is asked for where nothing is missing; a term of the library is said with the verdict.
  d.verdict = diagnosis::Verdict::consistent;
  EXPECT_EQ(report::diagnosis_in_brief(d).next, "");
  d.verdict = diagnosis::Verdict::unexplained;
  d.not_examined = {{.term = "temperature_drift", .missing = covariate("temperature").set()}};
  EXPECT_EQ(report::diagnosis_in_brief(d).next, "");
  EXPECT_NE(report::sentence(d).find("Not examined: temperature_drift"), std::string::npos);
}

}  // namespace
}  // namespace drift::not_examined_words_test
