#include <gtest/gtest.h>

#include <limits>

#include "core/base/check.hpp"
#include "core/estimate/strapdown/dwells.hpp"
#include "tests/support/strapdown_recording.hpp"

namespace drift::strapdown::strapdown_dwells_test {
namespace {

using test::strapdown_recording;
using test::StrapdownScript;

TEST(StrapdownDwells, AreFoundWhereTheCaseRests) {
  const StrapdownScript script{.dwells = 12, .rest = 6.0, .turn = 2.0};
  const Signals signals = signals_of(strapdown_recording(script, Theta::Zero()));
  const DwellSearch search = find_dwells(signals, {});
  ASSERT_EQ(search.dwells.size(), 12u);
  for (std::size_t d = 0; d < 12; ++d) {
    const double start = 8.0 * static_cast<double>(d);
    // Never beyond the rest; at most two half windows (0.5 s) and the slow onset of motion shorter.
    EXPECT_GE(search.dwells[d].start, start) << d;
    EXPECT_LE(search.dwells[d].start, start + 0.6) << d;
    EXPECT_LE(search.dwells[d].end, start + 6.0 + 0.02) << d;
    EXPECT_GE(search.dwells[d].end, start + 6.0 - 0.6) << d;
  }
}

TEST(StrapdownDwells, ShorterThanStaticMinDoNotCount) {
  const StrapdownScript script{.dwells = 12, .rest = 3.0, .turn = 2.0};
  const Signals signals = signals_of(strapdown_recording(script, Theta::Zero()));
  EXPECT_EQ(find_dwells(signals, {.static_min = 2.0}).dwells.size(), 12u);
  EXPECT_EQ(find_dwells(signals, {.static_min = 4.0}).dwells.size(), 0u);
}

TEST(StrapdownDwells, AreQuietForStaticMinAndHalfAWindowIsCutFromBothEnds) {
  const StrapdownScript script{.dwells = 12, .rest = 3.0, .turn = 2.0};
  const Signals signals = signals_of(strapdown_recording(script, Theta::Zero()));
  const DwellSearch found = find_dwells(signals, {.static_min = 2.0, .window = 0.5});
  ASSERT_EQ(found.dwells.size(), 12u);
  for (const Dwell& d : found.dwells) {
    EXPECT_GE(d.quiet, 2.0);
    EXPECT_NEAR(d.quiet - d.duration(), 0.5, 0.011);  // a row at either end
  }
  EXPECT_EQ(found.longest_left, 0.0);
  // Those of 3 s are quiet for a window less, and up to a window more where the turn begins slowly.
  const DwellSearch none = find_dwells(signals, {.static_min = 4.0, .window = 0.5});
  EXPECT_TRUE(none.dwells.empty());
  EXPECT_GT(none.longest_left, 2.0);
  EXPECT_LT(none.longest_left, 3.5);
}

TEST(StrapdownDwells, DoNotDependOnWhereTheClockBegins) {
  // Ten rows a second: a window of half a second is two rows and a half to either side.
  const StrapdownScript script{.dwells = 8, .rest = 12.0, .turn = 4.0, .interval = 0.1};
  const Recording recording = strapdown_recording(script, Theta::Zero());
  const DwellSearch here = find_dwells(signals_of(recording), {});
  ASSERT_EQ(here.dwells.size(), 8u);
  for (const double later : {0.1, 8.0, 1000.0, 1.7e9}) {
    Recording shifted = recording;
    for (Channel& c : shifted.channels)
      if (c.name == "time")
        for (double& t : c.values) t += later;
    const DwellSearch there = find_dwells(signals_of(shifted), {});
    ASSERT_EQ(there.dwells.size(), 8u) << later;
    for (std::size_t d = 0; d < 8; ++d) {
      EXPECT_EQ(there.dwells[d].first, here.dwells[d].first) << later;
      EXPECT_EQ(there.dwells[d].last, here.dwells[d].last) << later;
    }
  }
}

TEST(StrapdownDwells, ARecordingAtRestIsOneDwell) {
  const StrapdownScript script{.dwells = 1, .rest = 60.0};
  const Signals signals = signals_of(strapdown_recording(script, Theta::Zero()));
  const DwellSearch search = find_dwells(signals, {});
  ASSERT_EQ(search.dwells.size(), 1u);
  EXPECT_GT(search.dwells[0].duration(), 58.9);  // less half a window at each end, twice
}

TEST(StrapdownDwells, ASteadyTurnAboutTheVerticalIsNoRest) {
  // Both sensors are as quiet as at rest; only the mean rate tells.
  Recording recording = strapdown_recording({.dwells = 12}, Theta::Zero());
  const double start = 22.5 + 0.5, end = 22.5 + 4.5;  // inside the fourth dwell
  for (std::size_t k = 0; k < recording.rows(); ++k)
    if (const double t = recording.channels[0].values[k]; t > start && t < end)
      recording.channels[3].values[k] += 0.2;  // [rad/s]
  const DwellSearch search = find_dwells(signals_of(recording), {});
  EXPECT_EQ(search.dwells.size(), 11u);
  for (const Dwell& d : search.dwells) EXPECT_FALSE(d.start > start && d.end < end);
}

TEST(StrapdownDwells, TwoSamplesNotMeasuredEndADwell) {
  Recording recording = strapdown_recording({.dwells = 1, .rest = 20.0}, Theta::Zero());
  for (const std::size_t k : {1000u, 1001u})
    recording.channels[2].values[k] = std::numeric_limits<double>::quiet_NaN();
  const DwellSearch search = find_dwells(signals_of(recording), {});
  ASSERT_EQ(search.dwells.size(), 2u);
  EXPECT_LT(search.dwells[0].end, 10.0);
  EXPECT_GT(search.dwells[1].start, 10.0);
}

TEST(StrapdownSignals, ALoneEmptyCellIsOnTheLineBetweenItsNeighboursAsALostRowWouldBe) {
  Recording r = strapdown_recording({.dwells = 1}, Theta::Zero());
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  auto& time = r.channels[0].values;
  auto &gyro = r.channels[1].values, &acc = r.channels[6].values;
  for (std::size_t k = 0; k < time.size(); ++k) gyro[k] = acc[k] = 0.3 + 2.0 * time[k];
  for (const std::size_t k : {0u, 20u, 40u, 41u, 60u, 80u}) gyro[k] = none;
  acc[30] = none;
  for (auto& c : r.channels) {  // the row beside an empty cell is lost, and one far from any
    c.values.erase(c.values.begin() + 100);
    c.values.erase(c.values.begin() + 61);
  }
  r.lines.resize(r.rows());
  const Signals s = signals_of(r);
  for (const std::size_t k : {20u, 79u})
    EXPECT_NEAR(s.gyro[k].x(), 0.3 + 2.0 * s.time[k], 1e-12) << k;
  EXPECT_NEAR(s.acc[30].z(), 0.3 + 2.0 * s.time[30], 1e-12);
  EXPECT_EQ(s.gyro[20].y(), r.channels[2].values[20]);
  for (const std::size_t k : {0u, 40u, 41u, 60u}) EXPECT_FALSE(s.measured(k)) << k;
}

TEST(StrapdownSignals, EveryMissingChannelIsNamed) {
  Recording recording = strapdown_recording({.dwells = 1}, Theta::Zero());
  recording.channels[1].unit = unit::deg;
  recording.channels.pop_back();
  try {
    signals_of(recording);
    FAIL() << "accepted";
  } catch (const InputError& e) {
    EXPECT_EQ(e.code(), ExitCode::recording);
    ASSERT_EQ(e.messages().size(), 2u);
    EXPECT_NE(e.messages()[0].find("gyro_x"), std::string::npos);
    EXPECT_NE(e.messages()[1].find("acc_z"), std::string::npos);
  }
}

TEST(StrapdownSignals, TimeThatStandsStillIsRefused) {
  Recording recording = strapdown_recording({.dwells = 1}, Theta::Zero());
  recording.channels[0].values[7] = recording.channels[0].values[6];
  EXPECT_THROW(signals_of(recording), InputError);
}

}  // namespace
}  // namespace drift::strapdown::strapdown_dwells_test
