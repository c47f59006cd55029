#include "core/stats/median.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace drift::stats::median_test {
namespace {

TEST(Median, IsTheMiddleOfTheSortedValues) {
  EXPECT_EQ(median({3.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(median({4.0, 1.0, 2.0, 8.0}), 3.0);
  EXPECT_EQ(median({5.0}), 5.0);
}

TEST(Median, TheUpperOneOccursAmongTheValues) {
  EXPECT_EQ(upper_median({3.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(upper_median({4.0, 1.0, 2.0, 8.0}), 4.0);
}

TEST(Median, OfNothingIsNotKnown) {
  EXPECT_TRUE(std::isnan(median({})));
  EXPECT_TRUE(std::isnan(upper_median({})));
}

}  // namespace
}  // namespace drift::stats::median_test
