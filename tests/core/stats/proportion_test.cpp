#include "core/stats/proportion.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace drift::stats::proportion_test {
namespace {

TEST(Rate, HasTheWilsonInterval) {
  // Wilson (1927) as in Newcombe (1998), table I: 81 of 263 is 0.2553 to 0.3662; 0 of 20 is 0 to
  // 0.1611.
  const Rate a{81, 263}, none{0, 20}, all{20, 20}, many{0, 2000};
  EXPECT_NEAR(a.low(), 0.2553, 5e-5);
  EXPECT_NEAR(a.high(), 0.3662, 5e-5);
  EXPECT_EQ(none.low(), 0.0);
  EXPECT_NEAR(none.high(), 0.1611, 5e-5);
  EXPECT_NEAR(all.low(), 1.0 - 0.1611, 5e-5);
  EXPECT_EQ(all.high(), 1.0);
  EXPECT_EQ(many.low(), 0.0);  // where rounding of the formula gives 1e-19
  EXPECT_TRUE(std::isnan(Rate{}.value()));
}

TEST(Proportion, NothingOfNHasTheRuleOfThree) {
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
  const auto all = static_cast<double>(n);
  for (std::size_t number = 0; number <= k; ++number) {
    const auto i = static_cast<double>(number);
    sum += std::exp(std::lgamma(all + 1.0) - std::lgamma(i + 1.0) - std::lgamma(all - i + 1.0) +
                    i * std::log(p) + (all - i) * std::log1p(-p));
  }
  return sum;
}

TEST(Proportion, TheEndsLeaveTwoAndAHalfPercentInEachTail) {
  for (const auto& [k, n] : {std::pair<std::size_t, std::size_t>{5, 10}, {3, 64}, {90, 99}}) {
    const Proportion p = proportion(k, n);
    EXPECT_NEAR(at_most(k, n, p.high), 0.025, 1e-10);
    EXPECT_NEAR(1.0 - at_most(k - 1, n, p.low), 0.025, 1e-10);
  }
}

TEST(Proportion, OfNoTrialsNothingIsKnown) {
  const Proportion p = proportion(0, 0);
  EXPECT_TRUE(std::isnan(p.share()));
  EXPECT_EQ(p.low, 0.0);
  EXPECT_EQ(p.high, 1.0);
}

}  // namespace
}  // namespace drift::stats::proportion_test
