// Rates that are made of a million runs are told with the digits that a million runs give.
#include <gtest/gtest.h>

#include "analysis/report/study/results.hpp"

namespace drift::rare_rates_test {
namespace {

TEST(RareRates, HaveAnIntervalOfSomeWidth) {
  EXPECT_EQ(report::rate_cell({1, 1000000}).text, "0.00010 % (0.00002 to 0.00057)");
  EXPECT_EQ(report::rate_cell({0, 100000}).text, "0.0000 % (0.0000 to 0.0038)");
  EXPECT_EQ(report::percent_cell(3.8e-5).text, "0.0038");
}

TEST(RareRates, OthersHaveOneDecimal) {
  EXPECT_EQ(report::rate_cell({120, 400}).text, "30.0 % (25.7 to 34.7)");
  EXPECT_EQ(report::rate_cell({0, 400}).text, "0.0 % (0.0 to 1.0)");
  EXPECT_EQ(report::percent_cell(0.0).text, "0.0");
  EXPECT_EQ(report::percent_cell(0.123).text, "12.3");
}

}  // namespace
}  // namespace drift::rare_rates_test
