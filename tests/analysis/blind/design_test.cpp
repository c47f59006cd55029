#include "analysis/blind/design.hpp"

#include <gtest/gtest.h>

#include <map>

namespace drift::blind::design_test {
namespace {

mc::BlindSpec spec() {
  mc::BlindSpec s;
  s.trials = 320;
  s.couplings = {Coupling::eq5, Coupling::eq6, Coupling::servo};
  s.modes = {CommandLaw::free, CommandLaw::level};
  s.sizes = {4.0, 8.0, 12.0};
  return s;
}

TEST(BlindDesign, StrataHaveTheirSharesAndAddUp) {
  std::map<Stratum, std::size_t> count;
  for (const TrialPlan& t : design_trials(spec(), 1)) ++count[t.stratum];
  // Shares of 320 trials: 64, 48, 128, 32, 25.6, 22.4; whole numbers by largest remainder.
  EXPECT_EQ(count[Stratum::null], 64u);
  EXPECT_EQ(count[Stratum::wrong_noise], 48u);
  EXPECT_EQ(count[Stratum::single], 128u);
  EXPECT_EQ(count[Stratum::pair], 32u);
  EXPECT_EQ(count[Stratum::outside], 26u);
  EXPECT_EQ(count[Stratum::local], 22u);
}

TEST(BlindDesign, PlansCouplingsAndSizesAreSpreadEvenlyInEveryStratum) {
  std::map<Stratum, std::map<std::string, int>> plans;
  std::map<double, int> sizes;
  std::map<Stratum, std::map<Coupling, int>> couplings;
  for (const TrialPlan& t : design_trials(spec(), 1)) {
    ++plans[t.stratum][t.plan];
    ++couplings[t.stratum][t.coupling];
    if (t.stratum == Stratum::single) ++sizes[t.size];
  }
  const auto even = [](const auto& counts) {
    int low = 1 << 30, high = 0;
    for (const auto& [key, n] : counts) {
      low = std::min(low, n);
      high = std::max(high, n);
    }
    return high - low <= 1;
  };
  for (const auto& [stratum, counts] : plans) EXPECT_TRUE(even(counts) && counts.size() == 3);
  for (const auto& [stratum, counts] : couplings) EXPECT_TRUE(even(counts) && counts.size() == 3);
  EXPECT_TRUE(even(sizes) && sizes.size() == 3);
}

TEST(BlindDesign, TheNumberOfATrialSaysNothingAndTheSeedEverything) {
  const auto a = design_trials(spec(), 1), b = design_trials(spec(), 1),
             c = design_trials(spec(), 2);
  std::size_t runs = 1, differ = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k].number, k + 1);
    EXPECT_EQ(a[k].stratum, b[k].stratum);
    EXPECT_EQ(a[k].size, b[k].size);
    differ += a[k].stratum != c[k].stratum;
    runs += k > 0 && a[k].stratum != a[k - 1].stratum;
  }
  // In random order neighbours differ with probability 1 - sum of squared shares = 0.75: 239 +- 8
  // of 319.
  EXPECT_NEAR(static_cast<double>(runs), 239.0, 5 * 8.0);
  EXPECT_GT(differ, 150u);
}

TEST(BlindDesign, SizesAreDrawnBetweenTheirEndsWithoutAList) {
  mc::BlindSpec s = spec();
  s.sizes.clear();
  for (const TrialPlan& t : design_trials(s, 3)) {
    if (t.stratum != Stratum::single && t.stratum != Stratum::local) continue;
    EXPECT_GE(t.size, s.smallest);
    EXPECT_LE(t.size, s.largest);
  }
}

}  // namespace
}  // namespace drift::blind::design_test
