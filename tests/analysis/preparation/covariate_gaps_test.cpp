// Columns that terms may follow, where they have no reading.
#include "analysis/preparation/covariates/covariate_gaps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace drift::preparation::covariate_gaps_test {
namespace {

double course(double t) {
  return 20.0 + 0.002 * t;
}

/// A row a minute, the temperature (on a straight line) read where `read` says so.
Recording log(std::size_t rows, const std::function<bool(std::size_t)>& read) {
  Recording r;
  r.channels = {{"time", unit::s, {}}, {"temperature", "degC"_unit, {}}};
  for (std::size_t row = 0; row < rows; ++row) {
    r.channels[0].values.push_back(60.0 * static_cast<double>(row + 1));
    r.channels[1].values.push_back(read(row) ? course(r.channels[0].values.back()) : nan_value);
    r.lines.push_back(row + 2);
  }
  return r;
}

/// Rows that are left without a number.
std::vector<std::size_t> unknown(const Recording& r) {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < r.rows(); ++row)
    if (std::isnan(r.channels[1].values[row])) rows.push_back(row);
  return rows;
}

TEST(CovariateGaps, WhatIsReadNowAndThenIsKnownInBetween) {
  // Every fifth row; twice an hour by hand, after 15 to 45 min.
  const std::vector<std::size_t> by_hand{3, 18, 51, 80, 110, 155, 190, 207, 235};
  const std::function<bool(std::size_t)> logs[] = {
      [](std::size_t row) { return row % 5 == 4; },
      [&](std::size_t row) { return std::ranges::find(by_hand, row) != by_hand.end(); }};
  for (const auto& read : logs) {
    Recording r = log(240, read);
    const std::vector<ColumnGaps> gaps = bridge_covariates(r);
    ASSERT_EQ(gaps.size(), 1u);
    EXPECT_EQ(gaps[0].column.name, "temperature");
    EXPECT_EQ(gaps[0].unknown, 0u);
    EXPECT_TRUE(unknown(r).empty());
    for (std::size_t row = 4; row < 235; ++row)
      EXPECT_NEAR(r.channels[1].values[row], course(r.channels[0].values[row]), 1e-12) << row;
    EXPECT_EQ(r.channels[1].values[0], r.channels[1].values[read(3) ? 3 : 4]);  // held
  }
}

TEST(CovariateGaps, OneReadingThatIsMissingIsBridgedAndMoreAreNot) {
  Recording r = log(100, [](std::size_t row) {
    return row != 10 && (row < 40 || row > 41) && (row < 60 || row > 79) && row < 97;
  });
  const std::vector<ColumnGaps> gaps = bridge_covariates(r);
  ASSERT_EQ(gaps.size(), 1u);
  EXPECT_EQ(gaps[0].rows, 26u);
  EXPECT_EQ(gaps[0].of, 100u);
  EXPECT_NEAR(gaps[0].seconds, 26.0 * 60.0, 1e-9);
  EXPECT_NEAR(gaps[0].longest, 20.0 * 60.0, 1e-9);
  EXPECT_EQ(gaps[0].line, 62u);
  // Behind the last reading one row is as near to it as readings are to each other.
  std::vector<std::size_t> expected{40, 41};
  for (std::size_t row = 60; row < 80; ++row) expected.push_back(row);
  expected.insert(expected.end(), {98, 99});
  EXPECT_EQ(unknown(r), expected);
  EXPECT_EQ(gaps[0].unknown, expected.size());
  EXPECT_NEAR(r.channels[1].values[10], course(660.0), 1e-12);
}

/// Time that passes while nothing is recorded is none in which readings are missing.
TEST(CovariateGaps, APauseOfTheLogIsNone) {
  Recording r = log(60, [](std::size_t row) { return row % 5 == 2; });
  for (std::size_t row = 30; row < 60; ++row) r.channels[0].values[row] += 7200.0;
  EXPECT_EQ(bridge_covariates(r).at(0).unknown, 0u);
  EXPECT_TRUE(unknown(r).empty());
}

TEST(CovariateGaps, OneReadingHoldsAndNoneIsLeft) {
  Recording once = log(50, [](std::size_t row) { return row == 7; });
  EXPECT_EQ(bridge_covariates(once).at(0).unknown, 0u);
  for (const double x : once.channels[1].values) EXPECT_EQ(x, course(480.0));
  Recording never = log(50, [](std::size_t) { return false; }),
            always = log(50, [](std::size_t) { return true; });
  EXPECT_TRUE(bridge_covariates(never).empty());
  EXPECT_EQ(unknown(never).size(), 50u);
  EXPECT_TRUE(bridge_covariates(always).empty());
}

}  // namespace
}  // namespace drift::preparation::covariate_gaps_test
