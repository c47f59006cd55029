// How explanations are weighed against each other, on made-up ones whose answer is known.
#include "analysis/search/credible_set.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/search/detect.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::search::credible_set_test {
namespace {

using test::param;

struct Case {
  Fitted e;
  std::vector<Refit> refits;
  CredibleSet out;

  Case() { e.unknown.emplace(); }

  std::size_t candidate(std::string term, std::string axis, std::vector<std::size_t> params) {
    e.set.candidates.push_back(
        {term, axis, term + "." + axis, std::move(params), {inference::Variant{}}});
    return e.set.candidates.size() - 1;
  }
  void explanation(std::size_t candidate, double log_bayes, double excess) {
    Refit r;
    r.choices = {{candidate, 0}};
    r.log_bayes = log_bayes;
    r.excess = excess;
    refits.push_back(std::move(r));
  }
  bool can_be_weighed(Leftover left = Leftover::nothing, Sizes sizes = Sizes::of_library) const {
    return search::can_be_weighed(e, refits, left, sizes);
  }
  void weigh() { out = search::weigh(e, std::move(refits), SearchOptions{}.credible); }
};

TEST(CredibleSet, AFarBetterExplanationDoesNotLoseToAPoorOneForATrifle) {
  Case c;
  const auto magnetic = c.candidate("magnetic_drift", "x", {param("M_x")});
  const auto gimbal = c.candidate("gimbal_angle_drift", "y", {param("G_c_y")});
  c.explanation(magnetic, 37.5, 0.4);  // beside it something unrelated is just significant
  c.explanation(gimbal, 31.0, -0.1);   // happens to cover that too
  ASSERT_TRUE(c.can_be_weighed());
  c.weigh();
  ASSERT_EQ(c.out.sets.size(), 1u);
  EXPECT_EQ(c.out.sets[0].choices[0].candidate, magnetic);
  // Odds of their evidence, the price of the chance taken off.
  EXPECT_NEAR(c.out.probability[0], 1.0 / (1.0 + std::exp(31.0 - (37.5 - 0.4))), 1e-12);
}

TEST(CredibleSet, OfTheValleysOfASettingTheDeepestIsStated) {
  Case c;
  const auto step = c.candidate("mass_unbalance_step", "z", {param("dD_I_z")});
  c.e.set.candidates[step].variants.resize(2);
  c.explanation(step, 40.0, -1.0);
  c.explanation(step, 38.5, -1.0);
  c.refits[1].choices[0].variant = 1;
  c.refits[0].after.fit.estimate.statistic = 104.0;
  c.refits[1].after.fit.estimate.statistic = 100.0;
  c.weigh();
  ASSERT_EQ(c.out.sets.size(), 1u);
  EXPECT_EQ(c.out.sets[0].choices[0].variant, 1u);
  EXPECT_NEAR(c.out.probability[0], 1.0, 1e-12);
  ASSERT_EQ(c.out.beside.size(), 1u);
  EXPECT_EQ(c.out.beside[0].choices[0].variant, 0u);
}

TEST(CredibleSet, FitsAtSeveralSettingsAreOneExplanationAndNotTwo) {
  Case c;
  const auto step = c.candidate("mass_unbalance_step", "z", {param("dD_I_z")});
  c.e.set.candidates[step].variants.resize(2);
  const auto gimbal = c.candidate("gimbal_angle_drift", "y", {param("G_c_y")});
  c.explanation(step, 30.0, -1.0);
  c.explanation(step, 30.0, -1.0);
  c.refits[1].choices[0].variant = 1;
  c.explanation(gimbal, 30.0, -1.0);
  c.weigh();
  ASSERT_EQ(c.out.sets.size(), 2u);
  EXPECT_NEAR(c.out.probability[0], 0.5, 1e-12);
  EXPECT_NEAR(c.out.probability[1], 0.5, 1e-12);
}

TEST(CredibleSet, WhatIsNotListedKeepsItsProbability) {
  Case c;
  const auto magnetic = c.candidate("magnetic_drift", "x", {param("M_x")});
  const auto gimbal = c.candidate("gimbal_angle_drift", "y", {param("G_c_y")});
  c.explanation(magnetic, 30.0, -1.0);
  c.explanation(gimbal, 30.0 - std::log(24.0), -1.0);
  c.weigh();
  ASSERT_EQ(c.out.sets.size(), 1u);
  ASSERT_EQ(c.out.unlisted.size(), 1u);
  EXPECT_EQ(c.out.unlisted[0].choices[0].candidate, gimbal);
  EXPECT_NEAR(c.out.unlisted[0].probability, 1.0 / 25.0, 1e-12);
}

TEST(CredibleSet, WhatLeavesFarTooMuchIsNoExplanationHoweverGood) {
  Case c;
  const auto magnetic = c.candidate("magnetic_drift", "x", {param("M_x")});
  const auto gimbal = c.candidate("gimbal_angle_drift", "y", {param("G_c_y")});
  c.explanation(magnetic, 60.0, 3.1);
  c.explanation(gimbal, 20.0, -1.0);
  ASSERT_TRUE(c.can_be_weighed());
  c.weigh();
  ASSERT_EQ(c.out.sets.size(), 1u);
  EXPECT_EQ(c.out.sets[0].choices[0].candidate, gimbal);
  EXPECT_EQ(c.out.rejected.size(), 1u);
  Case less;
  less.explanation(less.candidate("magnetic_drift", "x", {param("M_x")}), 60.0, 2.9);
  EXPECT_TRUE(less.can_be_weighed(Leftover::chance));
}

TEST(CredibleSet, ASizeThatNobodyExpectsEndsNoSearchUntilAllIsTried) {
  Case c;
  c.explanation(c.candidate("magnetic_drift", "x", {param("M_x")}), 40.0, -1.0);
  c.refits.front().as_found = true;
  EXPECT_FALSE(c.can_be_weighed());
  EXPECT_TRUE(c.can_be_weighed(Leftover::nothing, Sizes::as_found));
  c.explanation(c.candidate("gimbal_angle_drift", "y", {param("G_c_y")}), 39.0, -1.0);
  EXPECT_TRUE(c.can_be_weighed());
}

TEST(CredibleSet, WithoutAnAdequateOneThereIsNoneUnlessChanceIsAskedFor) {
  Case c;
  c.explanation(c.candidate("magnetic_drift", "x", {param("M_x")}), 40.0, 0.5);
  EXPECT_FALSE(c.can_be_weighed());
  EXPECT_TRUE(c.can_be_weighed(Leftover::chance));
  c.weigh();
  EXPECT_EQ(c.out.sets.size(), 1u);
}

TEST(CredibleSet, LambdaThatIsNotSettledCompetesButIsNoAdequateExplanation) {
  Case c;
  c.explanation(c.candidate("frame_closure", "", {param("lambda")}), 40.0, -3.0);
  c.refits.back().nameable = false;
  EXPECT_FALSE(c.can_be_weighed());
  c.explanation(c.candidate("magnetic_drift", "x", {param("M_x")}), 20.0, -3.0);
  ASSERT_TRUE(c.can_be_weighed());
  c.weigh();
  EXPECT_FALSE(c.out.sets[0].nameable);
  EXPECT_GT(c.out.probability[0], 0.999);
}

TEST(CredibleSet, SomethingUnknownThatIsFarBetterLeavesNone) {
  Case c;
  c.explanation(c.candidate("magnetic_drift", "x", {param("M_x")}), 40.0, -1.0);
  c.e.unknown->lone.gain = 2.0 * (40.0 + 5.0 + 0.05 * 40.0 + std::log(21.0)) + 0.1;
  EXPECT_FALSE(c.can_be_weighed());
  c.e.unknown->lone.gain -= 0.2;
  EXPECT_TRUE(c.can_be_weighed());
}

TEST(CredibleSet, ListsWhatTogetherHoldsWithNinetyFivePerCent) {
  const auto listed = [](double probability) {
    Case c;
    c.explanation(c.candidate("magnetic_drift", "x", {param("M_x")}), 30.0, -1.0);
    c.explanation(c.candidate("gimbal_angle_drift", "y", {param("G_c_y")}),
                  30.0 - std::log(probability / (1.0 - probability)), -1.0);
    c.weigh();
    EXPECT_NEAR(c.out.probability[0], probability, 1e-12);
    return c.out.sets.size();
  };
  EXPECT_EQ(listed(0.949), 2u);
  EXPECT_EQ(listed(0.951), 1u);
}

TEST(CredibleSet, AFurtherCauseHasItsShareOfAllThatIsMissingOnTheMean) {
  Case c;
  const auto magnetic = c.candidate("magnetic_drift", "x", {param("M_x")});
  const auto gimbal = c.candidate("gimbal_angle_drift", "y", {param("G_c_y")});
  const auto ramp = c.candidate("drift_ramp", "z", {param("ramp_z")});
  c.explanation(magnetic, 30.0, -1.0);
  c.explanation(gimbal, 30.0, -1.0);
  c.refits.back().choices.push_back({ramp, 0});
  c.weigh();
  // Nothing is missing in half of all tests: ln 2 terms are on the mean, one of three.
  const double odds = std::log(2.0) / 3.0;
  EXPECT_NEAR(c.out.probability[0], 1.0 / (1.0 + odds), 1e-12);
}

TEST(CredibleSet, MoreParametersMustBringTwentyToOne) {
  const auto widest = [](double gain) {
    Case c;
    c.explanation(c.candidate("torquer_scale", "", {param("s_x"), param("s_y"), param("s_z")}),
                  30.0 + gain, -1.0);
    c.explanation(c.candidate("torquer_scale", "x", {param("s_x")}), 30.0, -1.0);
    c.weigh();
    return c.out.sets.at(0).choices[0].candidate == 0;
  };
  EXPECT_FALSE(widest(std::log(20.0)));
  EXPECT_TRUE(widest(std::log(20.2)));
}

TEST(CredibleSet, PartsOfOneTermAreOneCause) {
  Case c;
  const auto group =
      c.candidate("misalignment_creep", "", {param("eta_t_x"), param("eta_t_y"), param("eta_t_z")});
  const auto axis = c.candidate("misalignment_creep", "z", {param("eta_t_z"), param("xi_t_z")});
  c.explanation(group, 27.4, -1.0);
  c.explanation(axis, 27.0, -1.0);
  ASSERT_TRUE(c.can_be_weighed());
  c.weigh();
  ASSERT_EQ(c.out.sets.size(), 1u);
  EXPECT_EQ(c.out.sets[0].choices[0].candidate, group);
  EXPECT_NEAR(c.out.probability[0], 1.0, 1e-12);
}

}  // namespace
}  // namespace drift::search::credible_set_test
