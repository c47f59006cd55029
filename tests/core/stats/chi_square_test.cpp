#include "core/stats/chi_square.hpp"

#include <gtest/gtest.h>

#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <numbers>

#include "core/stats/chi_square_band.hpp"
#include "core/stats/normal.hpp"

namespace drift::stats::chi_square_test {
namespace {

TEST(ChiSquare, TailsAreExactWhereTheyHaveAClosedForm) {
  // Even degrees are exponentials times polynomials, one degree is the error function; erfc is good
  // down to 1e-300. 1e-14 of the log: the rounding of T and of lgamma.
  for (const double T : {0.1, 1.0, 5.0, 30.0, 300.0, 3000.0, 3e5}) {
    EXPECT_NEAR(log_tail(T, 2.0), -0.5 * T, 1e-14 * T);
    EXPECT_NEAR(log_tail(T, 4.0), -0.5 * T + std::log1p(0.5 * T), 1e-14 * T + 1e-15);
    if (T < 1000.0) {
      EXPECT_NEAR(log_tail(T, 1.0), std::log(std::erfc(std::sqrt(0.5 * T))), 1e-14 * T + 1e-15);
    }
  }
  EXPECT_EQ(log_tail(0.0, 3.0), 0.0);
}

TEST(ChiSquare, TheFarTailIsBoostsWhereBoostHasOne) {
  // Down to 1e-300, from where the continued fraction has converged.
  for (const double dof : {1.0, 2.0, 3.0, 7.0, 18.0, 60.0})
    for (double T = 3.0 * dof + 60.0; T < 1200.0; T *= 1.3) {
      const double boost = std::log(boost::math::gamma_q(0.5 * dof, 0.5 * T));
      EXPECT_NEAR(log_far_tail(T, dof), boost, 2e-14 * std::abs(boost)) << dof << " " << T;
    }
}

TEST(ChiSquare, TheTailHasNoStepWhereBoostEnds) {
  // d log P / dT is within 1 % of -1/2 there; half of that would be a step of 1e-3 in T.
  for (const int dof : {1, 3, 9})
    for (double T = 1300.0; T < 1500.0; T += 1.0) {
      const double fall = strength(T + 1.0, dof) - strength(T, dof);
      EXPECT_NEAR(fall, 0.5, 0.005) << dof << " " << T;
    }
}

TEST(ChiSquare, StrengthHasItsInverse) {
  for (const int dof : {1, 3, 12})
    for (const double T : {0.5, 23.0, 400.0, 5000.0})
      EXPECT_NEAR(quantile_of_strength(strength(T, dof), dof), T, 1e-9 * T + 1e-9) << dof;
  EXPECT_EQ(strength(5.0, 0), 0.0);
}

TEST(ChiSquare, DeviateIsTheNormalNumberOfTheSameTail) {
  // One degree is the square of a normal number: twice the tail of that.
  for (const double z : {0.5, 1.0, 3.0, 8.0, 30.0, 36.0})
    EXPECT_NEAR(deviate(z * z, 1.0), -normal_quantile(std::erfc(z / std::numbers::sqrt2)), 1e-9);
  EXPECT_NEAR(deviate(2000.0, 2.0) - deviate(1379.0, 2.0), 7.59, 0.02)
      << "no step where the tail is no number any more: sqrt(2000) - sqrt(1379)";
  // Many degrees are normal, skewed by the third of sqrt(2/dof) times (z^2 - 1).
  const double dof = 1e6;
  EXPECT_NEAR(deviate(dof + 5.0 * std::sqrt(2.0 * dof), dof), 5.0,
              24.0 / 3.0 * std::sqrt(2.0 / dof));
  EXPECT_LT(deviate(1e-9, 4.0), -7.0);
}

TEST(ChiSquareBand, HoldsTheMiddleOfTheDistribution) {
  // Two degrees are an exponential; of others 2.5 % lie beyond either end.
  EXPECT_NEAR(chi_square_band(2.0).low, -std::log(0.975), 1e-12);
  EXPECT_NEAR(chi_square_band(2.0).high, -std::log(0.025), 1e-12);
  for (const double dof : {1.0, 6.0, 20.0, 1e6}) {
    const Band band = chi_square_band(dof);
    EXPECT_NEAR(log_tail(dof * band.high, dof), std::log(0.025), 1e-9) << dof;
    EXPECT_NEAR(log_tail(dof * band.low, dof), std::log(0.975), 1e-9) << dof;
    for (const double end : {band.low, band.high})
      EXPECT_NEAR(chi_square_chance(end, dof), 0.05, 1e-9) << dof;
  }
  EXPECT_TRUE(std::isnan(chi_square_band(0.0).low));
  EXPECT_FALSE(chi_square_band(0.0).holds(1.0));
  EXPECT_EQ(chi_square_chance(1e300, 3.0), 0.0);
}

}  // namespace
}  // namespace drift::stats::chi_square_test
