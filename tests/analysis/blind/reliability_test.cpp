// What stated probabilities are worth.
#include "analysis/blind/reliability.hpp"

#include <gtest/gtest.h>

namespace drift::blind::reliability_test {
namespace {

TEST(BlindReliability, WhatCouldBeNamedIsTheSurestForThePriceOfAWrongName) {
  const auto trial = [](Belief::Kind kind, double probability, bool right) {
    TrialScore s;
    s.answer.belief = {kind, probability, {}};
    s.believed_right = right;
    return s;
  };
  using Kind = Belief::Kind;
  // Expected to be wrong, the surest first: 0, 0.02, 0.12, 0.52.
  const std::vector<TrialScore> all{trial(Kind::named, 0.6, true), trial(Kind::named, 1.0, true),
                                    trial(Kind::outside, 1.0, true), trial(Kind::named, 0.9, false),
                                    trial(Kind::named, 0.98, true)};
  const auto right = [&](double wrong) { return right_if_named_by_probability(all, wrong).k; };
  EXPECT_EQ(right(0.0), 1u);
  EXPECT_EQ(right(0.03 / 5.0), 2u);
  EXPECT_EQ(right(0.13 / 5.0), 2u);  // the third is named, and wrong
  EXPECT_EQ(right(0.53 / 5.0), 3u);
  EXPECT_EQ(right_if_named_by_probability(all, 0.0).n, 5u);
}

}  // namespace
}  // namespace drift::blind::reliability_test
