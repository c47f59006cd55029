// Remarks about rows: those that repeat earlier ones, and gaps.
#include "core/recording/rows/row_remarks.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <functional>

#include "core/base/rng.hpp"
#include "core/recording/rows/quality_card.hpp"
#include "core/recording/rows/repeated_rows.hpp"
#include "recording_fixture.hpp"

namespace drift::row_remarks_test {
namespace {

using namespace test;

using Reading = std::function<double(int row, int axis)>;

/// Positions of `dwell` rows, 10 s apart.
Recording positions_of(int count, int dwell, const Reading& reading) {
  Recording r;
  r.channels = {{"time", unit::s, {}},           {"position", unit::one, {}},
                {"phase", unit::one, {}},        {"acc_x", *parse_unit("g"), {}},
                {"acc_y", *parse_unit("g"), {}}, {"acc_z", *parse_unit("g"), {}}};
  for (int row = 0; row < count * dwell; ++row) {
    r.channels[0].values.push_back(10.0 * (row + 1));
    r.channels[1].values.push_back(row / dwell + 1);
    r.channels[2].values.push_back(0.0);
    for (int axis = 0; axis < 3; ++axis)
      r.channels[static_cast<std::size_t>(3 + axis)].values.push_back(reading(row, axis));
    r.lines.push_back(static_cast<std::size_t>(row) + 2);
  }
  return r;
}

/// Noise of 10 ug about the attitudes of every second position, in steps.
Reading noise(int dwell, double step) {
  auto stream = std::make_shared<Stream>(7, 0, Purpose::test);
  return [=](int row, int axis) {
    const double x = (axis == row / dwell % 2 ? 1.0 : 0.0) + 1e-5 * stream->normal();
    return step > 0.0 ? step * std::round(x / step) : x;
  };
}

void copy_rows(Recording& r, std::size_t from, std::size_t to, std::size_t count) {
  for (std::size_t c = 3; c < 6; ++c)
    for (std::size_t i = 0; i < count; ++i)
      r.channels[c].values[to + i] = r.channels[c].values[from + i];
}

std::string first_remark(const Recording& r) {
  const auto texts = quality_card(r, RecordingKind::platform).remarks.texts();
  return texts.empty() ? "" : texts.front();
}

TEST(RowRemarks, APositionThatRepeatsAnotherIsSaidFirstWithItsRows) {
  Recording r = positions_of(6, 20, noise(20, 0.0));
  EXPECT_TRUE(repeated_rows(r).empty());
  copy_rows(r, 20, 60, 20);
  r.channels[4].values[24] = r.channels[4].values[64] = NAN;  // not measured, in both
  r.channels[5].values.assign(120, 0.0);                      // another remark of its weight
  EXPECT_EQ(first_remark(r),
            "lines 62 to 81 (position 4, from 610 s on) hold the readings of lines 22 to 41 "
            "(position 2, from 210 s on), number for number: copied into the log by mistake?");
}

TEST(RowRemarks, NoiseIsSeenInReadingsThatDrift) {
  const Reading noisy = noise(10, 0.0);
  Recording r = positions_of(6, 10, [&](int row, int axis) {
    return noisy(row, axis) + 4e-3 * (row % 10) - 1e-5 * (row % 10) * (row % 10);
  });
  copy_rows(r, 10, 30, 10);
  ASSERT_EQ(repeated_rows(r).size(), 1u);
  EXPECT_EQ(repeated_rows(r)[0].again, 30u);
  EXPECT_EQ(repeated_rows(r)[0].count, 10u);
}

TEST(RowRemarks, RatesThatAFileOfIncrementsGivesAreTheSameToNineDigits) {
  Recording r = positions_of(6, 20, noise(20, 0.0));
  copy_rows(r, 20, 60, 20);
  for (std::size_t row = 60; row < 80; ++row) r.channels[3].values[row] *= 1.0 + 1e-15;
  EXPECT_EQ(repeated_rows(r).size(), 1u);
}

TEST(RowRemarks, StretchesThatRepeatEarlierOnesAreFoundWhereverTheyAre) {
  Recording r = positions_of(6, 500, noise(500, 2e-6));  // a readout in steps of a fifth of a sigma
  EXPECT_TRUE(repeated_rows(r).empty());
  copy_rows(r, 130, 2300, 90);
  copy_rows(r, 700, 1450, 120);  // over the end of a position
  const auto all = repeated_rows(r);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].first, 700u);
  EXPECT_EQ(all[0].again, 1450u);
  EXPECT_EQ(all[0].count, 120u);
  EXPECT_EQ(all[1].again, 2300u);
  EXPECT_EQ(all[1].count, 90u);
  EXPECT_NE(first_remark(r).find("positions 3 to 4"), std::string::npos) << first_remark(r);
  EXPECT_NE(first_remark(r).find("one other stretch"), std::string::npos) << first_remark(r);
}

TEST(RowRemarks, WhatIsAlikeWithoutNoiseIsNoCopy) {
  const auto none = [](const Reading& reading) {
    return repeated_rows(positions_of(8, 60, reading)).empty();
  };
  EXPECT_TRUE(none([](int row, int axis) { return axis == row / 60 % 2 ? 1.0 : 0.0; }));
  EXPECT_TRUE(none([](int row, int axis) { return 1e-6 * (row % 60) + (axis == row / 60 % 2); }));
  EXPECT_TRUE(none([](int row, int axis) { return 1e-3 * (row % 60 / 20) + (axis == 0); }))
      << "a staircase";
  EXPECT_TRUE(none([](int row, int axis) {
    return 61.035156e-6 * std::floor(0.37 * (row % 60) + 0.3 * axis) + (axis == 0);
  })) << "a staircase of counts, drifting";
  const auto smooth = [](int row, int axis) { return std::sin(1e-3 * (row % 120) + axis); };
  EXPECT_TRUE(none(smooth));
  EXPECT_TRUE(none([&](int row, int axis) { return 1e-7 * std::round(1e7 * smooth(row, axis)); }))
      << "rounded";
  EXPECT_TRUE(none([](int, int axis) { return axis == 2 ? 1.0 : NAN; })) << "nothing measured";
  EXPECT_TRUE(none(noise(60, 2e-5))) << "steps of two sigmas: two or three values";
}

TEST(RowRemarks, ChanceMakesNoRepeatsInManyRecordings) {
  // Expected are fewer than 300 * 1e-4 = 0.03: one in 300 would have a chance of 3 %.
  int found = 0;
  for (int k = 0; k < 300; ++k) {
    Stream stream(11, static_cast<std::uint64_t>(k), Purpose::test);
    const double step = 1e-5 * (0.5 + 3.0 * stream.uniform());
    found += repeated_rows(positions_of(4, 250,
                                        [&](int, int) {
                                          return step * std::round(1e-5 * stream.normal() / step);
                                        }))
                     .empty()
                 ? 0
                 : 1;
  }
  EXPECT_EQ(found, 0);
}

TEST(RowRemarks, ALongRecordingThatStandsStillIsLookedThroughInAMoment) {
  const Recording r = positions_of(4, 250'000, [](int row, int) { return row % 1000 == 0; });
  const auto begin = std::chrono::steady_clock::now();
  repeated_rows(r);
  // A tenth of a second; a search of every row against every one would take a quarter of an hour.
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
}

TEST(RowRemarks, InALongRecordingACopyIsFoundFromItsFirstRowOn) {
  Recording r = positions_of(4, 75'000, noise(75'000, 0.0));
  copy_rows(r, 12'345, 250'001, 1000);
  const auto all = repeated_rows(r);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].first, 12'345u);
  EXPECT_EQ(all[0].again, 250'001u);
  EXPECT_EQ(all[0].count, 1000u);
}

/// Later by `length` from a row on.
void delay(Recording& r, std::size_t row, double length) {
  for (std::size_t i = row; i < r.rows(); ++i) r.channels[0].values[i] += length;
}

TEST(RowRemarks, TheLongestGapStandsBeforeWhatIsLessHarm) {
  Recording r = positions_of(6, 60, noise(60, 0.0));
  delay(r, 30, 20.0);
  delay(r, 100, 3600.0);
  r.channels[4].values.assign(360, NAN);  // another remark of its weight
  EXPECT_EQ(first_remark(r),
            "2 gaps within positions, the longest 3610 s after 1020 s (line 102): about 362 rows "
            "are missing");
}

TEST(RowRemarks, AGapOfAFewRowsIsSaidBehindWhatIsWrong) {
  Recording r = positions_of(6, 60, noise(60, 0.0));
  delay(r, 30, 20.0);
  EXPECT_NE(first_remark(r).find("1 gap within positions"), std::string::npos) << first_remark(r);
  r.channels[4].values.assign(360, NAN);
  EXPECT_EQ(first_remark(r), "acc_y: nothing was measured");
}

TEST(RowRemarks, OneGapBetweenPositionsThatFollowWithoutIsDoubtful) {
  Recording r = positions_of(6, 60, noise(60, 0.0));
  delay(r, 180, 3600.0);
  EXPECT_EQ(first_remark(r).find("no gimbal angles"), std::string::npos) << first_remark(r);
  EXPECT_NE(first_remark(r).find("the longest 3610 s after 1800 s (line 182)"), std::string::npos)
      << first_remark(r);
  EXPECT_NE(first_remark(r).find("interrupted?"), std::string::npos) << first_remark(r);
  for (std::size_t row : {60, 120, 240, 300}) delay(r, row, 300.0);
  const auto texts = quality_card(r, RecordingKind::platform).remarks.texts();
  ASSERT_GE(texts.size(), 2u);
  EXPECT_EQ(texts[0], "no gimbal angles");
  EXPECT_EQ(texts[1],
            "5 gaps between positions, the longest 3610 s after 2400 s (line 182): normal if the "
            "platform was caged there");
}

}  // namespace
}  // namespace drift::row_remarks_test
