// Limits of analysis/inference/thresholds.hpp that the search applies, met from both sides.
#include <gtest/gtest.h>

#include "analysis/search/chance_thresholds.hpp"
#include "analysis/search/pairs.hpp"
#include "analysis/search/scores/remainder.hpp"

namespace drift::search::thresholds_test {
namespace {

/// Candidates of one column each with this information and these scores.
Field field_of(const MatX& C, const VecX& g) {
  inference::CandidateSet set;
  for (Eigen::Index k = 0; k < g.size(); ++k)
    set.candidates.push_back({"term" + std::to_string(k),
                              "",
                              "",
                              {static_cast<std::size_t>(k)},
                              {{{static_cast<int>(k)}, {}}}});
  inference::Projected p;
  p.C = C;
  p.g = g;
  p.raw = C.diagonal();
  return {set, p, {}};
}

/// Two columns of the information given; `unlike` of the second cannot be copied by the first.
MatX alike(double information, double unlike) {
  MatX C(2, 2);
  C << information, information * std::sqrt(1.0 - unlike), 0.0, information;
  C(1, 0) = C(0, 1);
  return C;
}

TEST(ChanceThresholds, OfAPlanThatShowsNothingAreThoseOfNothing) {
  // A recording with a column in a wrong unit may leave no candidate that shows (was a crash).
  const Field nothing = field_of(MatX(0, 0), VecX(0));
  EXPECT_EQ(pair_null(nothing, 100).threshold(0.02), inference::MaxNull().threshold(0.02));
  EXPECT_EQ(inference::MaxNull::draw(MatX(0, 0), 3, 1).rows(), 3);
}

TEST(ChanceThresholds, AreExceededWithTheirShareOfTheChance) {
  const ChanceThresholds t =
      chance_thresholds(field_of(MatX::Identity(6, 6), VecX::Zero(6)), 0.02, 4000);
  // The maximum of six chi-squares of one degree, counted in 4000 draws beyond 2.5 %, by its tail
  // below: three errors of the hundred draws that fix the tail.
  EXPECT_NEAR(t.library.p_value(t.library_threshold), 0.02 * 0.5, 1e-4);
  const double six = -std::log(-std::expm1(std::log1p(-0.01) / 6.0));
  EXPECT_NEAR(t.library_threshold, six, 3.0 / std::sqrt(100.0));
}

TEST(Remainder, WhatIsLeftOfATwinIsNoOtherEffect) {
  const auto left = [](double information, double unlike) {
    const VecX g = (VecX(2) << 0.0, 5.0 * std::sqrt(information * unlike)).finished();
    return remainder(field_of(alike(information, unlike), g), {{0, 0}}).library > 0.0;
  };
  EXPECT_FALSE(left(1e6, 0.9e-6));
  EXPECT_TRUE(left(1e6, 1.1e-6));
  // And there is something to see of it: a tenth of what makes a column observable.
  EXPECT_FALSE(left(1.0, 0.9e-3));
  EXPECT_TRUE(left(1.0, 1.1e-3));
}

TEST(Pairs, OfTwoNamesOfOneTraceAreNone) {
  const VecX g = (VecX(2) << 3.0, -3.0).finished();
  EXPECT_TRUE(strongest_pairs(field_of(alike(1.0, 0.99e-3), g), 1).empty());
  EXPECT_EQ(strongest_pairs(field_of(alike(1.0, 1.01e-3), g), 1).size(), 1u);
}

}  // namespace
}  // namespace drift::search::thresholds_test
