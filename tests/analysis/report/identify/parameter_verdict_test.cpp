// What a parameter of an identification is worth, told apart on identifications made by hand.
#include <gtest/gtest.h>

#include "analysis/report/identify/sections.hpp"
#include "tests/analysis/report/identify/identification_fixture.hpp"

namespace drift::parameter_verdict_test {
namespace {

using report::Worth;

/// Filter 0 of the fixture: it fits, every sigma is a tenth of the prior's.
struct Fitted {
  mc::Study study = testing::study();
  identification::Identification id = testing::identification(study);

  ParameterEstimate& parameter(std::size_t k) { return id.runs[0].batch.estimate.parameters[k]; }
  report::ParameterVerdict verdict(std::size_t k) const {
    return report::verdict_of({study, id, id.summaries[0]}, k);
  }
};

TEST(ParameterVerdict, IsLearnedWhereTheDataSaySo) {
  EXPECT_EQ(Fitted().verdict(0).worth, Worth::learned);
}

TEST(ParameterVerdict, IsThePriorWhereLittleOfItWasTakenOff) {
  Fitted f;
  f.parameter(3).sigma = 0.81 * f.parameter(3).prior_sigma;
  EXPECT_EQ(f.verdict(3).worth, Worth::prior_only);
  f.parameter(3).sigma = 0.79 * f.parameter(3).prior_sigma;
  EXPECT_EQ(f.verdict(3).worth, Worth::learned);
}

TEST(ParameterVerdict, IsInASumAloneWhereThePriorDecidesMostOfItsVariance) {
  // Two parameters whose difference no datum sees: each keeps 1/2 of the prior's variance.
  Fitted f;
  VecX unseen = VecX::Zero(static_cast<Eigen::Index>(f.id.summaries[0].layout.size()));
  unseen[1] = unseen[2] = std::sqrt(0.5);
  f.id.summaries[0].degeneracies = {{0.0, unseen}};
  for (const std::size_t k : {1u, 2u})
    f.parameter(k).sigma = std::sqrt(0.5 + 0.01) * f.parameter(k).prior_sigma;
  EXPECT_EQ(f.verdict(1).worth, Worth::sum_only);
  EXPECT_EQ(f.verdict(2).worth, Worth::sum_only);
  EXPECT_EQ(f.verdict(0).worth, Worth::learned);
  const report::InBrief brief = report::identification_in_brief(f.study, f.id);
  EXPECT_NE(brief.more[0].find("2 known in sums with others alone"), std::string::npos)
      << brief.more[0];
}

TEST(ParameterVerdict, IsWrongBeyondFiveSigmaOfAKnownTruth) {
  Fitted f;
  f.parameter(4).value += 6.0 * f.parameter(4).sigma;
  EXPECT_EQ(f.verdict(4).worth, Worth::wrong);
  EXPECT_NEAR(f.verdict(4).off, 6.0, 1e-9);
}

TEST(ParameterVerdict, IsNotToBeTrustedWhereTheFilterMisfits) {
  Fitted f;
  f.id.runs[0].batch.estimate.statistic = 3000.0;  // of 1000 scalars
  EXPECT_EQ(f.verdict(0).worth, Worth::untrusted);
}

TEST(ParameterVerdict, DependsOnTheStartWhereTheStartsDisagree) {
  Fitted f;
  f.id.summaries[0].spread[5].ekf = 20.0;
  EXPECT_EQ(f.verdict(5).worth, Worth::start_dependent);
}

}  // namespace
}  // namespace drift::parameter_verdict_test
