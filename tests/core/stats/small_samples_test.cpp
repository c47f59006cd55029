#include "core/stats/small_samples.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/stats/normal.hpp"

namespace drift::stats::small_samples_test {
namespace {

TEST(StudentsT, HasClosedFormsOfOneAndTwoDegreesAndTheNormalLimit) {
  for (const double p : {0.5, 0.68, 0.95, 0.99}) {
    EXPECT_NEAR(t_half_width(p, 1.0), std::tan(0.5 * std::numbers::pi * p),
                1e-12 * t_half_width(p, 1.0));  // Cauchy
    EXPECT_NEAR(t_half_width(p, 2.0), p * std::sqrt(2.0 / (1.0 - p * p)), 1e-12);
    // t = z + (z^3 + z) / (4 n) + ... (Cornish and Fisher).
    const double z = normal_half_width(p), n = 1e4;
    EXPECT_NEAR(t_half_width(p, n), z + (z * z * z + z) / (4.0 * n), 1e-6);
  }
}

TEST(SmallSamples, TailsAreThoseOfTables) {
  EXPECT_NEAR(beyond_t(2.262157, 9.0), 0.05, 1e-6);
  EXPECT_NEAR(beyond_t(-4.780913, 9.0), 0.001, 1e-7);
  EXPECT_NEAR(beyond_f(3.633089, 4.0, 9.0), 0.05, 1e-6);
  EXPECT_EQ(beyond_t(-HUGE_VAL, 9.0), 0.0);
  EXPECT_EQ(beyond_f(HUGE_VAL, 4.0, 9.0), 0.0);
}

}  // namespace
}  // namespace drift::stats::small_samples_test
