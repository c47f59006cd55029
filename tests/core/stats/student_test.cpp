#include "core/stats/student.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/stats/normal.hpp"

namespace drift::stats::student_test {
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

}  // namespace
}  // namespace drift::stats::student_test
