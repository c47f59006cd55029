#include "core/recording/rows/row_spacing.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace drift::row_spacing_test {
namespace {

/// Slews of `seconds` rows a second apart, each followed by a dwell of ten minutes.
Recording mixed(int positions, int seconds) {
  Recording r;
  r.channels = {{"time", unit::s, {}}, {"position", unit::one, {}}, {"phase", unit::one, {}}};
  double t = 0.0;
  const auto add = [&](double step, int position, double phase) {
    t += step;
    r.channels[0].values.push_back(t);
    r.channels[1].values.push_back(position);
    r.channels[2].values.push_back(phase);
    r.lines.push_back(r.lines.size() + 1);
  };
  for (int p = 1; p <= positions; ++p) {
    for (int k = 0; k < seconds; ++k) add(1.0, p, 1.0);
    for (int k = 0; k < 10; ++k) add(60.0, p, 0.0);
  }
  return r;
}

Recording without(Recording r, std::size_t row) {
  for (Channel& c : r.channels) c.values.erase(c.values.begin() + static_cast<std::ptrdiff_t>(row));
  r.lines.erase(r.lines.begin() + static_cast<std::ptrdiff_t>(row));
  return r;
}

TEST(RowSpacing, SecondsInSlewsAndMinutesInDwellsAreBothUsual) {
  const RowSpacing s = row_spacing(mixed(3, 50));
  EXPECT_FALSE(s.regular);
  EXPECT_DOUBLE_EQ(s.shortest, 1.0);
  EXPECT_DOUBLE_EQ(s.longest, 60.0);
  EXPECT_DOUBLE_EQ(s.jitter, 0.0);
  for (std::size_t row = 0; row < s.step.size(); ++row) EXPECT_FALSE(s.gap(row)) << row;
}

TEST(RowSpacing, KnowsALostRowInEither) {
  for (const std::size_t lost : {20u, 53u, 50u, 59u}) {  // slew, dwell, first and last of a dwell
    const RowSpacing s = row_spacing(without(mixed(3, 50), lost));
    for (std::size_t row = 1; row < s.step.size(); ++row) {
      // Behind the last row of a dwell comes a slew: 61 s where one second is usual.
      EXPECT_EQ(s.gap(row), row == lost) << row << " where " << lost << " is lost";
    }
    EXPECT_DOUBLE_EQ(s.missing(lost), 1.0) << lost;
  }
  // The last second of a slew: the way to the first minute of the dwell is a second too long.
  const RowSpacing s = row_spacing(without(mixed(3, 50), 49));
  EXPECT_FALSE(s.gap(49));
  EXPECT_TRUE(s.longer(49));
  EXPECT_FALSE(row_spacing(mixed(3, 50)).longer(50));
}

TEST(RowSpacing, KnowsThemWhereEveryOtherRowIsLost) {
  Recording r;
  r.channels = {{"time", unit::s, {}}, {"position", unit::one, {}}, {"phase", unit::one, {}}};
  std::vector<bool> behind_gap;
  for (int k = 1; k <= 24; ++k) {
    if (k >= 13 && k % 2 == 1) continue;  // 13, 15, ... 23 are lost
    r.channels[0].values.push_back(60.0 * k);
    r.channels[1].values.push_back(1.0);
    r.channels[2].values.push_back(0.0);
    r.lines.push_back(r.lines.size() + 1);
    behind_gap.push_back(k > 13);
  }
  const RowSpacing s = row_spacing(r);
  for (std::size_t row = 1; row < s.step.size(); ++row)
    EXPECT_EQ(s.gap(row), behind_gap[row]) << row;
}

/// Three positions of 20 rows a minute apart, then one whose rows are these minutes apart.
Recording minutes_and(const std::vector<double>& steps) {
  Recording r;
  r.channels = {{"time", unit::s, {}}, {"position", unit::one, {}}};
  double t = 0.0;
  const auto add = [&](double minutes, double position) {
    r.channels[0].values.push_back(t += 60.0 * minutes);
    r.channels[1].values.push_back(position);
    r.lines.push_back(r.lines.size() + 1);
  };
  for (int k = 0; k < 60; ++k) add(1.0, 1 + k / 20);
  for (const double step : steps) add(step, 4.0);
  return r;
}

TEST(RowSpacing, UnevenStepsOfThoseThatAreUsualAreLostRows) {
  // Nine and eleven rows of twenty are left; one of eight steps, and one of ten, is as usual.
  for (const std::vector<double>& left : {std::vector{2.0, 2.0, 2.0, 2.0, 3.0, 3.0, 1.0, 2.0, 3.0},
                                          {1.0, 2.0, 3.0, 1.0, 3.0, 2.0, 2.0, 3.0, 2.0, 2.0}}) {
    const Recording r = minutes_and(left);
    const RowSpacing s = row_spacing(r);
    for (std::size_t row = 60; row < r.rows(); ++row) {
      EXPECT_NEAR(s.usual[row], 60.0, 1e-9) << row;
      EXPECT_EQ(s.gap(row), left[row - 60] > 1.0) << row;
      if (s.gap(row)) {
        EXPECT_DOUBLE_EQ(s.missing(row), left[row - 60] - 1.0) << row;
      }
    }
  }
}

TEST(RowSpacing, WhatNamesNoPositionMayBeReadNowAndThen) {
  Recording r = minutes_and({1.0, 2.0, 3.0, 1.0, 3.0, 2.0, 2.0, 3.0, 2.0, 2.0, 3.0, 2.0, 2.0, 3.0});
  EXPECT_NEAR(row_spacing(r).usual[68], 60.0, 1e-9);
  r.channels.pop_back();
  EXPECT_DOUBLE_EQ(row_spacing(r).usual[68], 120.0);
}

TEST(RowSpacing, EvenStepsAreMeansOverLonger) {
  // Of 120 s throughout, with one lost, with one of 60 s between; and far longer than is usual.
  std::vector<double> even(12, 2.0), lost = even, split = even, far(16, 60.0);
  lost[6] = 4.0;
  split[6] = 1.0;
  for (const std::size_t k : {2u, 8u, 14u}) far[k] = 1.0;
  for (const auto& [steps, usual] :
       {std::pair{even, 120.0}, {lost, 120.0}, {split, 120.0}, {far, 3600.0}}) {
    const Recording r = minutes_and(steps);
    const RowSpacing s = row_spacing(r);
    for (std::size_t row = 61; row < r.rows(); ++row) EXPECT_DOUBLE_EQ(s.usual[row], usual) << row;
  }
}

/// Positions of so many rows each at these distances, without a pause between them; and its plan.
struct Dwells {
  Recording recording;
  std::vector<double> planned;

  explicit Dwells(std::initializer_list<std::pair<int, double>> positions) {
    recording.channels = {{"time", unit::s, {}}, {"position", unit::one, {}}};
    double t = 0.0, number = 0.0;
    for (const auto& [rows, sample] : positions) {
      number += 1.0;
      for (int k = 0; k < rows; ++k) {
        recording.channels[0].values.push_back(t += sample);
        recording.channels[1].values.push_back(number);
        recording.lines.push_back(recording.lines.size() + 1);
        planned.push_back(sample);
      }
    }
  }

  std::vector<double> planned_without(std::size_t row) const {
    std::vector<double> others = planned;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(row));
    return others;
  }
};

TEST(RowSpacing, AFewRowsOfAPositionAreUsualInItsOwnSampleOfThePlan) {
  // Two rows, and one, show less of their distance than the plan says.
  const Dwells d{{2, 300.0}, {20, 60.0}, {4, 300.0}, {1, 120.0}};
  const RowSpacing s = row_spacing(d.recording, d.planned);
  for (std::size_t row = 0; row < d.planned.size(); ++row) {
    EXPECT_DOUBLE_EQ(s.usual[row], d.planned[row]) << row;
    EXPECT_FALSE(s.gap(row)) << row;
  }
  const RowSpacing lost = row_spacing(without(d.recording, 24), d.planned_without(24));
  for (std::size_t row = 1; row < lost.step.size(); ++row)
    EXPECT_EQ(lost.gap(row), row == 24) << row;
}

TEST(RowSpacing, SecondsStaySecondsWhateverSampleThePlanHas) {
  const Dwells d{{3, 1.0}, {5, 1.0}, {4, 1.0}};
  std::vector<double> planned;
  for (const double position : d.recording.channels[1].values)
    planned.push_back(position == 2.0 ? 60.0 : 300.0);
  const RowSpacing s = row_spacing(d.recording, planned);
  for (const double usual : s.usual) EXPECT_DOUBLE_EQ(usual, 1.0);
}

TEST(RowSpacing, WithoutAPlanAFewRowsThatAreAlikeAreUsual) {
  const Dwells d{{4, 300.0}, {20, 60.0}, {6, 100.0}};
  const RowSpacing s = row_spacing(d.recording);
  for (std::size_t row = 0; row < d.planned.size(); ++row) {
    EXPECT_DOUBLE_EQ(s.usual[row], d.planned[row]) << row;
    EXPECT_FALSE(s.gap(row)) << row;
  }
}

TEST(RowSpacing, EvenRowsAreRegularWhateverPassesBetweenPositions) {
  Recording r = mixed(3, 0);
  EXPECT_TRUE(row_spacing(r).regular);
  for (std::size_t k = 10; k < 30; ++k) r.channels[0].values[k] += 1000.0;
  EXPECT_TRUE(row_spacing(r).regular);
  r.channels[0].values[15] += 0.1;
  EXPECT_FALSE(row_spacing(r).regular);
  EXPECT_FALSE(row_spacing(without(mixed(3, 0), 15)).regular);
}

}  // namespace
}  // namespace drift::row_spacing_test
