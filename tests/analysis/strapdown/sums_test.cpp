// What of a strapdown unit is said as a sum, and in whose convention.
#include "analysis/strapdown/sums.hpp"

#include <gtest/gtest.h>

#include "analysis/strapdown/sensed.hpp"

namespace drift::strapdown::sums_test {
namespace {

EstimateResult estimate_of(std::initializer_list<const char*> keys, const MatX& P) {
  EstimateResult e;
  e.covariance = P;
  Eigen::Index k = 0;
  for (const char* key : keys) {
    const std::size_t param = *TermLibrary::find(key);
    const double prior = TermLibrary::specs[param].prior_si().sigma();
    e.parameters.push_back({param, 0.0, 0.5 * prior, prior * std::sqrt(P(k, k)), 0.0, prior});
    ++k;
  }
  return e;
}

/// Neither is known, their sum is: variance 1e-4 along (1, 1) and 1 across.
MatX only_the_sum() {
  const double along = 1e-4, across = 1.0;
  return (MatX(2, 2) << along + across, along - across, along - across, along + across).finished() /
         2.0;
}

TEST(Sums, MembersOfOtherUnitsCarryWhatTurnsThemIntoThatOfTheSum) {
  // Priors 1 deg/h and 2 deg/h/g: one prior sigma of the first is half of one of the second.
  const auto drift = known_sums(estimate_of({"D_F_z", "D_I_z"}, only_the_sum()));
  ASSERT_EQ(drift.size(), 1u);
  EXPECT_TRUE(drift[0].key == "D_F_z + 0.5 g D_I_z" || drift[0].key == "D_I_z + 2 1/g D_F_z")
      << drift[0].key;
  const auto mixed = known_sums(estimate_of({"K0_x", "dO_y"}, only_the_sum()));
  ASSERT_EQ(mixed.size(), 1u);
  EXPECT_TRUE(mixed[0].key.find("(ug per arcsec)") != std::string::npos ||
              mixed[0].key.find("(arcsec per ug)") != std::string::npos)
      << mixed[0].key;
  const auto alike = known_sums(estimate_of({"eta_x", "xi_x"}, only_the_sum()));
  ASSERT_EQ(alike.size(), 1u);
  EXPECT_TRUE(alike[0].key == "eta_x + xi_x" || alike[0].key == "xi_x + eta_x") << alike[0].key;
}

TEST(Sums, AConventionIsNoKnowledge) {
  // D_I less the mean of the three: their sum is zero whatever the recording.
  const MatX less_mean = MatX::Identity(3, 3) - MatX::Constant(3, 3, 1.0 / 3.0);
  EXPECT_TRUE(known_sums(estimate_of({"D_I_x", "D_I_y", "D_I_z"}, less_mean)).empty());
}

/// A platform makes w = reading + s_a |reading| of what it is told; the sensor, reading = w - s_a
/// |w|.
TEST(AsSensed, WhatBendsAScaleFactorChangesItsSign) {
  for (const char* key : {"s_a_x", "s_a_z", "s_2_y", "s_T_x", "s_T3_z"})
    EXPECT_EQ(as_sensed(*TermLibrary::find(key), 1e-4, Vec3::Zero()), -1e-4) << key;
  EXPECT_EQ(as_sensed(*TermLibrary::find("K0_x"), 1e-4, Vec3::Zero()), 1e-4);
  const EstimateResult e =
      as_sensed(estimate_of({"s_a_x", "K0_x"}, MatX::Identity(2, 2) + 0.5 * MatX::Ones(2, 2)));
  EXPECT_LT(e.parameters[0].value, 0.0);
  EXPECT_EQ(e.covariance(0, 1), -0.5);
}

}  // namespace
}  // namespace drift::strapdown::sums_test
