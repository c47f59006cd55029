// Settings that a test does not tell apart share the evidence of a fit at one of them.
#include "analysis/search/settings_alike.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/search/setting_spread.hpp"
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

/// With 4, 8, 16 and 32 cycles per turn.
Fitted with_cycles(const MatX& C, const VecX& g) {
  Fitted e = with_settings(C, g);
  double cycles = 2.0;
  for (inference::Variant& v : e.set.candidates.front().variants)
    v.settings = {{test::param("enc_n"), cycles *= 2.0}};
  return e;
}

std::vector<double> credible_cycles(const Fitted& e, std::size_t fitted) {
  return credible_settings(e, {{0, fitted}}, 0, test::param("enc_n"), 0.95);
}

TEST(CredibleSettings, AreAllThatTheTestDoesNotTellApart) {
  const Fitted alike = with_cycles(MatX::Constant(4, 4, 100.0), VecX::Constant(4, 80.0));
  EXPECT_EQ(credible_cycles(alike, 1), (std::vector<double>{4.0, 8.0, 16.0, 32.0}));
  const Fitted one = with_cycles(100.0 * MatX::Identity(4, 4), VecX{{0.0, 0.0, 80.0, 0.0}});
  EXPECT_EQ(credible_cycles(one, 2), (std::vector<double>{16.0}));
  // What was fitted is told, whatever the linearised test says of it.
  EXPECT_EQ(credible_cycles(one, 0), (std::vector<double>{4.0, 16.0}));
}

}  // namespace
}  // namespace drift::search::settings_alike_test
