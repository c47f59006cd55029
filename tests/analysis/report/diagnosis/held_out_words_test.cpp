// What is said of held-out data agrees with the numbers beside it.
#include <gtest/gtest.h>

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

TEST(HeldOutWords, OfAMisfitWithoutANameItSaysHowBadItIs) {
  Diagnosis d;
  d.verdict = Verdict::unexplained;
  d.fit.chi2_per_dof_before = 1.18e7;
  d.fit.band_high = 1.2;
  EXPECT_TRUE(says(d, "chi-square per degree of freedom is 1.18e+07")) << report::sentence(d);
}

}  // namespace
}  // namespace drift::held_out_words_test
