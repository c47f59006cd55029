#include "core/stats/student.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/stats/normal.hpp"

namespace drift::stats::student_test {
namespace {

TEST(Student, TailsAreExactWhereTheyHaveAClosedForm) {
  // One degree is Cauchy's distribution, two have an algebraic tail; many are normal to 1/(4 dof).
  for (const double t : {-40.0, -2.0, -0.3, 0.0, 0.7, 3.0, 12.0}) {
    EXPECT_NEAR(student_tail(t, 1.0), std::atan2(1.0, t) / std::numbers::pi, 1e-14);
    EXPECT_NEAR(student_tail(t, 2.0), 0.5 - 0.5 * t / std::sqrt(2.0 + t * t), 1e-14);
    EXPECT_NEAR(student_tail(t, 1e6), normal_distribution(-t), 1e-6);
  }
}

}  // namespace
}  // namespace drift::stats::student_test
