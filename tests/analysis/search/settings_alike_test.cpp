// Settings that a test does not tell apart share the evidence of a fit at one of them.
#include "analysis/search/settings_alike.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/model_builders.hpp"

namespace drift::search::settings_alike_test {
namespace {

/// One candidate whose settings have the columns of C and g, one each.
Fitted with_settings(const MatX& C, const VecX& g) {
  inference::CandidateSet set;
  set.candidates.push_back({"encoder_harmonics", "outer", "", {test::param("enc_cn_outer")}, {}});
  for (int k = 0; k < g.size(); ++k) set.candidates.front().variants.push_back({{k}, {}});
  inference::Projected projected;
  projected.C = C;
  projected.g = g;
  projected.raw = VecX::Constant(g.size(), 100.0);
  Fitted e;
  static_cast<Field&>(e) = Field(std::move(set), std::move(projected), {});
  return e;
}

double share(const Fitted& e, std::size_t variant) {
  return std::exp(log_share_of_settings(e, {{0, variant}}));
}

TEST(SettingsAlike, AreAllOneWhereTheTestCannotTellThemApart) {
  const Fitted e = with_settings(MatX::Constant(4, 4, 100.0), VecX::Constant(4, 80.0));
  for (std::size_t v = 0; v < 4; ++v) EXPECT_NEAR(share(e, v), 1.0, 1e-12);
}

TEST(SettingsAlike, AreOneOfAllWhereOneAloneWillDo) {
  // 8 sigma of one setting: the others have exp(-32) of its evidence, by Schwarz's price more.
  const Fitted e = with_settings(100.0 * MatX::Identity(4, 4), VecX{{80.0, 0.0, 0.0, 0.0}});
  EXPECT_NEAR(share(e, 0), 0.25, 1e-9);
  // No setting counts for more than the one that was fitted.
  EXPECT_NEAR(share(e, 1), 1.0, 1e-9);
}

TEST(SettingsAlike, ThoseOfWhichNothingIsSeenAreNone) {
  MatX C = 100.0 * MatX::Identity(4, 4);
  C.bottomRightCorner(2, 2).setZero();
  const Fitted e = with_settings(C, VecX{{80.0, 0.0, 0.0, 0.0}});
  EXPECT_NEAR(share(e, 0), 0.5, 1e-9);
}

TEST(SettingsAlike, WhatLiesBetweenPointsStandsForTheBetterOfThem) {
  Fitted e = with_settings(100.0 * MatX::Identity(3, 3), VecX{{60.0, 80.0, 0.0}});
  e.set.candidates.front().variants[1].between = true;
  // Of two points: the first is the one it stands for, the other has nothing.
  EXPECT_NEAR(share(e, 1), 0.5, 1e-9);
}

}  // namespace
}  // namespace drift::search::settings_alike_test
