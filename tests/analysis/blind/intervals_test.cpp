#include "analysis/blind/intervals.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace drift::blind {
namespace {

TEST(Intervals, IncompleteBetaHasItsClosedForms) {
  for (const double x : {0.001, 0.1, 0.37, 0.5, 0.9, 0.999}) {
    EXPECT_NEAR(incomplete_beta(1.0, 7.0, x), 1.0 - std::pow(1.0 - x, 7.0), 1e-14);
    EXPECT_NEAR(incomplete_beta(5.0, 1.0, x), std::pow(x, 5.0), 1e-14);
    EXPECT_NEAR(incomplete_beta(2.0, 2.0, x), 3.0 * x * x - 2.0 * x * x * x, 1e-14);
  }
}

TEST(Intervals, NothingOfNHasTheRuleOfThree) {
  // k = 0: the upper end p has (1 - p)^n = 0.025.
  for (const std::size_t n : {1u, 10u, 60u, 1000u}) {
    const Proportion p = proportion(0, n);
    EXPECT_EQ(p.low, 0.0);
    EXPECT_NEAR(p.high, 1.0 - std::pow(0.025, 1.0 / static_cast<double>(n)), 1e-12);
    EXPECT_NEAR(proportion(n, n).low, 1.0 - p.high, 1e-12);
  }
}

/// Probability of k or fewer of n, summed.
double at_most(std::size_t k, std::size_t n, double p) {
  double sum = 0.0;
  for (std::size_t i = 0; i <= k; ++i)
    sum += std::exp(std::lgamma(n + 1.0) - std::lgamma(i + 1.0) - std::lgamma(n - i + 1.0) +
                    static_cast<double>(i) * std::log(p) +
                    static_cast<double>(n - i) * std::log1p(-p));
  return sum;
}

TEST(Intervals, TheEndsLeaveTwoAndAHalfPercentInEachTail) {
  for (const auto& [k, n] : {std::pair<std::size_t, std::size_t>{5, 10}, {3, 64}, {90, 99}}) {
    const Proportion p = proportion(k, n);
    EXPECT_NEAR(at_most(k, n, p.high), 0.025, 1e-10);
    EXPECT_NEAR(1.0 - at_most(k - 1, n, p.low), 0.025, 1e-10);
  }
}

TEST(Intervals, OfNoTrialsNothingIsKnown) {
  const Proportion p = proportion(0, 0);
  EXPECT_TRUE(std::isnan(p.share()));
  EXPECT_EQ(p.low, 0.0);
  EXPECT_EQ(p.high, 1.0);
}

}  // namespace
}  // namespace drift::blind
