// What a test hardly sees, from a square root of its information made by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/estimate/batch.hpp"

namespace drift::weak_directions_test {
namespace {

TEST(WeakDirections, KeepTheDigitsOfASmallSignal) {
  // Singular values s and t of this root: s t = 1e4 * 1e-7, s^2 + t^2 = 2e8 (and 1e-14), so that
  // t = 1e-7 / sqrt(2). Rounding moves it by about eps s = 3e-12; of R^T R, whose eigenvalue is
  // t^2 = 5e-15, rounding leaves eps s^2 = 4e-8.
  MatX root(2, 2);
  root << 1e4, 1e4, 0.0, 1e-7;
  const auto weak = weak_directions(root, unseen_information);
  ASSERT_EQ(weak.size(), 1u);
  EXPECT_NEAR(std::sqrt(weak[0].information), 1e-7 / std::sqrt(2.0), 1e-10);
  EXPECT_NEAR(std::abs(weak[0].direction.dot(VecX{{std::sqrt(0.5), -std::sqrt(0.5)}})), 1.0, 1e-12);
  EXPECT_EQ(exactly_unseen(weak, root), 0u);  // it is small, but more than rounding
  EXPECT_TRUE(weak_directions(MatX(), unseen_information).empty());
  root(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(weak_directions(root, unseen_information).empty());
}

TEST(WeakDirections, AreExactWhereRoundingAloneIsLeft) {
  const MatX root = MatX::Identity(4, 4) * 1e3;  // Frobenius norm 2e3
  const double rounding = rounding_signal(root);
  EXPECT_NEAR(rounding, 4.0 * std::numeric_limits<double>::epsilon() * 2e3, 1e-20);
  const VecX any = VecX::Unit(4, 0);
  EXPECT_EQ(exactly_unseen({{0.0, any},
                            {std::pow(0.9 * rounding, 2), any},
                            {std::pow(1.1 * rounding, 2), any},
                            {0.5 * unseen_information, any}},
                           root),
            2u);
}

}  // namespace
}  // namespace drift::weak_directions_test
