// What is said of held-out data agrees with the numbers beside it.
#include <gtest/gtest.h>

#include "analysis/report/diagnosis/report.hpp"
#include "analysis/report/diagnosis/words/sentence.hpp"
#include "analysis/report/diagnosis/words/words.hpp"

namespace drift::held_out_words_test {
namespace {

using namespace diagnosis;

bool says(const Diagnosis& d, const char* part) {
  return report::sentence(d).find(part) != std::string::npos;
}

TEST(HeldOutWords, OfHeldOutErrorsThatGrowItDoesNotSayThatTheyAreBetter) {
  Diagnosis d;
  d.verdict = Verdict::named;
  d.causes = {{.term = "g2_drift", .axis = "y"}};
  d.fit.held_out.folds.resize(6);
  d.fit.held_out.improves = true;
  d.of_case = d.has_patch = true;
  d.fit.held_out.log_score_gain = 12.8;
  d.fit.held_out.log_score_gain_sigma = 7.2;
  d.errors = {{"gyro rate in dwells", "deg/h", 0.018, 0.0181}};
  EXPECT_TRUE(says(d, "with it, held-out dwells are predicted better (chance"))
      << report::sentence(d);
  d.errors[0].after = 0.0232;
  EXPECT_TRUE(says(d, "are predicted better by their score (log score +12.8±7.2"))
      << report::sentence(d);
  EXPECT_TRUE(says(d, "not all errors become smaller (chance")) << report::sentence(d);
}

TEST(HeldOutWords, ErrorsHaveThreeDigitsAndNoPowersOfTen) {
  Diagnosis d;
  d.has_patch = true;
  d.errors = {{"gyro rate in dwells", "deg/h", 162.04, 34.71},
              {"gravity in dwells", "ug", 1094, 47}};
  EXPECT_EQ(report::errors_text(d),
            " Error on held-out data: gyro rate in dwells 162 → 34.7 deg/h, gravity in dwells 1094 "
            "→ 47 ug.");
}

TEST(HeldOutWords, WhereWholeRecordingsDisagreeItSaysThatAndNotThatPositionsDo) {
  Diagnosis d;
  d.verdict = Verdict::ambiguous;
  d.causes = {{.term = "reposition_transient", .axis = "z"}};
  d.where.recordings = {{"a.csv", 0.0, 900.0, 0.0}, {"b.csv", 900.0, 1800.0, 900.0}};
  HeldOut& held = d.fit.held_out;
  held.folds.resize(12);
  held.recordings.resize(2);
  held.log_score_gain = 67.6;
  held.recording_gain = -2.65;
  held.recordings_disagree = true;
  d.remarks.emplace_back(remark::NotPredicted{true});
  EXPECT_TRUE(says(d,
                   "but with it, held-out positions are predicted better, and whole recordings, "
                   "each from a fit to the others, are not: it may be in one recording only."))
      << report::sentence(d);
  EXPECT_FALSE(says(d, "no better"));
  const std::string remark = report::remarks_of(d).front();
  EXPECT_NE(remark.find("may be in one recording only. Diagnose each recording alone."),
            std::string::npos)
      << remark;
  EXPECT_EQ(remark.find("repeat that position"), std::string::npos);
  EXPECT_EQ(report::diagnosis_in_brief(d).next,
            "Next: diagnose each recording alone: what was found may be in one of them only.");
}

TEST(HeldOutWords, NumbersShowWhatIsSaidOfThem) {
  HeldOut held;
  held.folds.resize(12);
  held.log_score_gain = 5.0;
  held.chi2_per_dof_before = 1.1141;
  held.chi2_per_dof_after = 1.1097;
  EXPECT_EQ(report::held_out_sentence(held),
            "Data held out of the fit are predicted better: chi-square per degree of freedom 1.114 "
            "→ 1.110 in 12 folds, log score +5.");
  held.chi2_per_dof_before = 1.03;
  held.chi2_per_dof_after = 0.9988;
  EXPECT_NE(report::held_out_sentence(held).find("1.03 → 1.00 in"), std::string::npos);
  held.folds.clear();
  held.recordings.resize(2);
  held.recording_chi2_per_dof_before = held.recording_chi2_per_dof_after = 21.0;
  held.recording_gain = -0.5;
  EXPECT_NE(report::held_out_sentence(held).find("are predicted no better: 21 → 21, log"),
            std::string::npos)
      << report::held_out_sentence(held);
  held.recording_chi2_per_dof_after = 21.4;
  held.recording_gain = 3.0;
  EXPECT_NE(report::held_out_sentence(held).find("predicted better by their score: 21 → 21.4"),
            std::string::npos)
      << report::held_out_sentence(held);
}

TEST(HeldOutWords, OfAMisfitWithoutANameItSaysHowBadItIs) {
  Diagnosis d;
  d.verdict = Verdict::unexplained;
  d.fit.chi2_per_dof_before = 1.18e7;
  d.fit.band_high = 1.2;
  EXPECT_TRUE(says(d, "chi-square per degree of freedom is 1.18e+07")) << report::sentence(d);
}

}  // namespace
}  // namespace drift::held_out_words_test
