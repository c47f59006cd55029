#include "core/stats/normal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace drift::stats::normal_test {
namespace {

TEST(NormalQuantile, IsTheInverseOfTheDistributionFunction) {
  // Against values to 16 digits (Wichura 1988 gives the first two in his tests of AS 241; the tails
  // are standard): relative 1e-14.
  const double known[][2] = {{0.25, -0.6744897501960817},
                             {0.001, -3.090232306167814},
                             {1e-20, -9.262340089798408},
                             {0.975, 1.959963984540054},
                             {0.5, 0.0},
                             {0.8413447460685429, 1.0}};
  for (const auto& [p, z] : known)
    EXPECT_NEAR(normal_quantile(p), z, 1e-14 * std::max(1.0, std::abs(z))) << p;
  // The inverse loses what rounding of p near 1 costs: half an ulp of p over the density.
  for (double z = -8.0; z <= 5.0; z += 0.37) {
    const double density = std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
    const double tolerance =
        1e-14 * std::max(1.0, std::abs(z)) + 2.3e-16 * normal_distribution(z) / density;
    EXPECT_NEAR(normal_quantile(normal_distribution(z)), z, tolerance) << z;
  }
  EXPECT_NEAR(normal_half_width(0.95), half_width_95, 1e-14);
}

TEST(NormalSays, AnIntervalIsItsOwnWhileItsTailsAreWithinAFactorOfTwo) {
  EXPECT_TRUE(normal_says(5.0, 2.0, 5.0 - 2.0 * half_width_95, 5.0 + 2.0 * half_width_95));
  const double wide = normal_half_width(1.0 - 0.025), narrow = normal_half_width(1.0 - 0.1);
  EXPECT_TRUE(normal_says(0.0, 1.0, -0.999 * wide, 1.001 * narrow));
  EXPECT_FALSE(normal_says(0.0, 1.0, -1.001 * wide, half_width_95));
  EXPECT_FALSE(normal_says(0.0, 1.0, -half_width_95, 0.999 * narrow));
  EXPECT_FALSE(normal_says(0.0, 1.0, std::nan(""), half_width_95));
}

}  // namespace
}  // namespace drift::stats::normal_test
