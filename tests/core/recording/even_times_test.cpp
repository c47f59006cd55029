// Times that were written in steps which are coarse against the distance of the rows.
#include "core/recording/rows/even_times.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/base/rng.hpp"

namespace drift::even_times_test {
namespace {

/// Positions of 40 rows, or as many as are given, 60 s apart, written as `written` has it.
Recording rows(int positions, const std::function<double(double, int)>& written, int each = 40) {
  Recording r;
  r.channels = {{"time", unit::s, {}}, {"position", unit::one, {}}};
  int row = 0;
  for (int p = 1; p <= positions; ++p)
    for (int k = 0; k < each; ++k, ++row) {
      r.channels[0].values.push_back(written(60.0 * (row + 1), row));
      r.channels[1].values.push_back(p);
      r.lines.push_back(r.lines.size() + 1);
    }
  return r;
}

double rounded(double t, double step) {
  return step * std::round(t / step);
}

TEST(EvenTimes, HoursWithTwoDecimalsAreAMinuteApartAgain) {
  for (const double step : {36.0, 7.0, 0.7}) {
    const auto coarse = [&](double t, int) { return rounded(t, step); };
    Recording r = rows(12, coarse);
    take_even_times(r);
    ASSERT_FALSE(r.remarks.empty()) << step;
    const std::vector<double>& t = r.find("time")->values;
    for (std::size_t k = 0; k < t.size(); ++k) {
      // The mean of 40 errors of at most half a step that repeat after a few rows.
      EXPECT_NEAR(t[k], 60.0 * static_cast<double>(k + 1), 0.1 * step) << step << " " << k;
      if (k % 40 != 0) {
        EXPECT_NEAR(t[k] - t[k - 1], 60.0, 1e-3 * step) << step << " " << k;
      }
    }
  }
}

TEST(EvenTimes, ShortPositionsHaveTheDistanceOfTheWholeLog) {
  // Of twelve rows what is written repeats after three: 59.66 s by least squares in each position.
  Recording r = rows(
      12, [](double t, int) { return rounded(t, 36.0); }, 12);
  take_even_times(r);
  ASSERT_FALSE(r.remarks.empty());
  const std::vector<double>& t = r.find("time")->values;
  for (std::size_t k = 1; k < t.size(); ++k) EXPECT_NEAR(t[k] - t[k - 1], 60.0, 1e-9) << k;
}

TEST(EvenTimes, RowsOfWhichOneIsLostAreNotStretched) {
  // Two rows in every minute but one: 30.1 s would do for all that is written.
  Recording r = rows(6, [](double, int row) { return 60.0 * ((row + (row > 100)) / 2); });
  const std::vector<double> before = r.find("time")->values;
  take_even_times(r);
  EXPECT_EQ(r.find("time")->values, before);
}

TEST(EvenTimes, RowsThatShareAMinuteAreHalfOfItApart) {
  Recording r = rows(6, [](double t, int) { return 120.0 * std::floor(t / 120.0); });
  take_even_times(r);
  ASSERT_FALSE(r.remarks.empty());
  const std::vector<double>& t = r.find("time")->values;
  for (std::size_t k = 1; k < t.size(); ++k) {
    // Two rows a step: what is written is 0 or 60 s too early, 30 s in the mean of 40 rows.
    EXPECT_NEAR(t[k], 60.0 * static_cast<double>(k + 1) - 30.0, 1e-9) << k;
  }
}

TEST(EvenTimes, RowsThatWereWrittenTwiceStayAsTheyAre) {
  Recording r = rows(6, [](double, int row) { return 60.0 * (row / 2); });
  Channel acc{"acc_x", unit::g, {}};
  for (std::size_t k = 0; k < r.rows(); ++k) acc.values.push_back(static_cast<double>(k / 2));
  r.channels.push_back(acc);
  const std::vector<double> before = r.find("time")->values;
  take_even_times(r);
  EXPECT_EQ(r.find("time")->values, before);
  EXPECT_TRUE(r.remarks.empty());
}

TEST(EvenTimes, OtherRecordingsStayAsTheyAre) {
  Stream random(4, 0, Purpose::test);
  const std::function<double(double, int)> all[] = {
      [](double t, int) { return t; },
      [](double t, int) { return rounded(t, 0.1); },             // fine enough, and exact
      [&](double t, int) { return t + 3.0 * random.normal(); },  // rows that do scatter
      [](double t, int row) { return t + 60.0 * (row / 10); },   // every tenth is lost
      [](double, int row) { return 60.0 * (row - row / 5); },    // every fifth stands twice
      [](double, int row) { return row % 40 < 20 ? 30.0 * row : 60.0 * row - 600.0 * (row / 40); },
  };
  for (const auto& written : all) {
    Recording r = rows(4, written);
    const std::vector<double> before = r.find("time")->values;
    take_even_times(r);
    EXPECT_EQ(r.find("time")->values, before);
    EXPECT_TRUE(r.remarks.empty());
  }
}

}  // namespace
}  // namespace drift::even_times_test
