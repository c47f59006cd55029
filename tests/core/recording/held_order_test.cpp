#include "core/recording/rows/held_order.hpp"

#include <gtest/gtest.h>

namespace drift::held_order_test {
namespace {

TEST(HeldOrder, IsThatOfThePlanAndOfTheNumbersInIt) {
  const std::string advice = held_order_advice({3, 3, 1, 1, 1, 2, 2});
  EXPECT_NE(advice.find("held, 3, 1, 2, and number them in it"), std::string::npos) << advice;
}

TEST(HeldOrder, OfANumberThatComesBackIsNone) {
  const std::string advice = held_order_advice({1, 2, 2, 1});
  EXPECT_NE(advice.find("anew each time"), std::string::npos) << advice;
  EXPECT_EQ(advice.find("positions = {"), std::string::npos) << advice;
}

}  // namespace
}  // namespace drift::held_order_test
