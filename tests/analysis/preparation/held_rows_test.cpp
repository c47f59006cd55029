#include "analysis/preparation/held_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/six_positions.hpp"

namespace drift::preparation::held_rows_test {
namespace {

/// The rows from `first` on repeat that one.
void hold(Recording& r, std::size_t first, std::size_t rows) {
  for (Channel& c : r.channels)
    if (c.name.starts_with("acc_") || c.name.starts_with("gimbal_"))
      for (std::size_t i = 1; i <= rows; ++i) c.values[first + i] = c.values[first];
}

std::size_t missing(const Recording& r) {
  std::size_t count = 0;
  for (const double x : r.find("gimbal_outer")->values) count += std::isnan(x) ? 1 : 0;
  return count;
}

TEST(HeldRows, AreNotMeasured) {
  Recording r = test::simulated(test::six_study(1200.0));
  std::vector<std::string> remarks;
  leave_out_held_rows(r, remarks);
  EXPECT_TRUE(remarks.empty()) << remarks.front();
  hold(r, 5, 3);
  hold(r, 70, 4);
  leave_out_held_rows(r, remarks);
  EXPECT_EQ(missing(r), 7u);
  EXPECT_TRUE(std::isfinite(r.find("acc_x")->values[5]));
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_NE(remarks[0].find("7 rows repeat the row before in all 6 sensors"), std::string::npos)
      << remarks[0];
}

TEST(HeldRows, OfACoarseReadoutMayBeRead) {
  Recording r = test::simulated(test::six_study(1200.0));
  for (Channel& c : r.channels)
    if (c.name.starts_with("acc_") || c.name.starts_with("gimbal_"))
      for (double& x : c.values) x = 0.2 * std::round(x / 0.2);
  hold(r, 5, 3);
  std::vector<std::string> remarks;
  leave_out_held_rows(r, remarks);
  EXPECT_EQ(missing(r), 0u);
}

TEST(HeldRows, OfALogThatIsFasterThanItsSensorsAreLeft) {
  Recording r = test::simulated(test::six_study(1200.0));
  for (std::size_t i = 0; i + 1 < r.rows(); i += 2) hold(r, i, 1);
  std::vector<std::string> remarks;
  leave_out_held_rows(r, remarks);
  EXPECT_EQ(missing(r), 0u);
}

}  // namespace
}  // namespace drift::preparation::held_rows_test
