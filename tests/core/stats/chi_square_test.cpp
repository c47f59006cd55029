#include "core/stats/chi_square.hpp"

#include <gtest/gtest.h>

#include <boost/math/special_functions/gamma.hpp>
#include <cmath>

#include "core/stats/chi_square_band.hpp"

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

TEST(ChiSquareBand, HoldsTheMiddleOfTheDistribution) {
  // Exact ends by Boost; the header promises 0.01 from 6 degrees on and 0.1 below.
  for (const double dof : {1.0, 2.0, 6.0, 20.0, 1000.0}) {
    const Band band = chi_square_band(dof);
    const double low = boost::math::gamma_p_inv(0.5 * dof, 0.025) * 2.0 / dof;
    const double high = boost::math::gamma_q_inv(0.5 * dof, 0.025) * 2.0 / dof;
    EXPECT_NEAR(band.low, low, dof < 6.0 ? 0.1 : 0.01);
    EXPECT_NEAR(band.high, high, dof < 6.0 ? 0.1 : 0.01);
  }
}

}  // namespace
}  // namespace drift::stats::chi_square_test
