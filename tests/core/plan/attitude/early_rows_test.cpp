// Readings that stand a row early, against the numbers of the positions.
#include "core/plan/attitude/early_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>
#include <string>

#include "tests/support/attitude_scene.hpp"

namespace drift::early_rows_test {
namespace {

using test::expect_part;
using Scene = test::AttitudeScene;
using Names = std::initializer_list<const char*>;

constexpr Names accelerometers = {"acc_x", "acc_y", "acc_z"};
constexpr Names gimbals = {"gimbal_outer", "gimbal_middle", "gimbal_inner"};

void early(Scene& s, Names names) {
  for (const char* name : names) {
    std::vector<double>& rows = s.column(name);
    std::rotate(rows.begin(), rows.begin() + 1, rows.end());
    rows.back() = rows[rows.size() - 2];
  }
}

std::string said(Scene& s) {
  const auto wrong = s.mistakes();
  EXPECT_LE(wrong.size(), 1u);
  return wrong.empty() ? "" : wrong.front().text;
}

TEST(EarlyRows, ColumnsThatReadTheNextPositionInTheLastRowAreNamed) {
  Scene acc, angles, one;
  early(acc, accelerometers);
  expect_part(said(acc),
              "positions already shows the attitude of the next: columns acc_x, acc_y, acc_z "
              "stand a row early (expected readings and number of one instant in a row)");
  early(angles, gimbals);
  expect_part(said(angles), "stand a row early");
  expect_part(said(angles), "gimbal_inner");
  early(one, {"acc_y"});
  expect_part(said(one), "column acc_y stands a row early");
}

/// Numbers that come late are another mistake, which the diagnosis tells.
TEST(EarlyRows, WhereBothKindsReadItTheNumbersAreLate) {
  Scene both;
  early(both, accelerometers);
  early(both, gimbals);
  EXPECT_EQ(said(both).find("a row early"), std::string::npos);
}

TEST(EarlyRows, OneKindAloneOrTwoPositionsDoNotTell) {
  Scene alone;
  early(alone, accelerometers);
  for (const char* name : gimbals) std::ranges::fill(alone.column(name), nan_value);
  EXPECT_EQ(said(alone), "");
  // Only the first two positions read the next in their last rows.
  Scene two;
  const std::vector<double> position = two.column("position");
  for (const char* name : accelerometers) {
    std::vector<double>& values = two.column(name);
    for (std::size_t k = 0; k + 1 < values.size(); ++k)
      if (position[k + 1] != position[k] && position[k] < 2.5) values[k] = values[k + 1];
  }
  EXPECT_EQ(said(two), "");
}

}  // namespace
}  // namespace drift::early_rows_test
