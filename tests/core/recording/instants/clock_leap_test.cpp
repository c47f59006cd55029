// A clock that goes on by more than time does leaves what looks like a gap, across which nothing
// moved.
#include "core/recording/instants/clock_leap.hpp"

#include <gtest/gtest.h>

#include "core/recording/rows/quality_card.hpp"
#include "tests/support/six_positions.hpp"

namespace drift::clock_leap_test {
namespace {

Recording recorded(CommandLaw law, double sample, double dwell) {
  PlanDefaults defaults;
  defaults.dwell = dwell;
  defaults.sample = sample;
  defaults.mode = law;
  return test::simulated(test::six_study(defaults));
}

/// With every time from a row on so much too late.
Recording leapt(Recording r, std::size_t row, double seconds) {
  std::vector<double>& time = test::channel(r, "time");
  for (std::size_t k = row; k < time.size(); ++k) time[k] += seconds;
  return r;
}

Recording without_rows(Recording r, std::size_t first, std::size_t count) {
  const auto at = static_cast<std::ptrdiff_t>(first), n = static_cast<std::ptrdiff_t>(count);
  for (Channel& c : r.channels) c.values.erase(c.values.begin() + at, c.values.begin() + at + n);
  r.lines.erase(r.lines.begin() + at, r.lines.begin() + at + n);
  return r;
}

std::vector<ClockLeap> leaps_of(const Recording& r) {
  return clock_leaps(r, row_spacing(r));
}

TEST(ClockLeap, IsToldFromMissingRowsByWhatThePlatformDidMeanwhile) {
  const Recording r = recorded(CommandLaw::free, 60.0, 3600.0);
  for (const double seconds : {120.0, 3600.0, 1e6}) {
    const auto all = leaps_of(leapt(r, 90, seconds));
    ASSERT_EQ(all.size(), 1u) << seconds;
    EXPECT_EQ(all.front().row, 90u);
    EXPECT_NEAR(all.front().seconds, seconds, 1e-6);
  }
  for (const std::size_t count : {2u, 10u, 20u})
    EXPECT_TRUE(leaps_of(without_rows(r, 80, count)).empty()) << count;
}

TEST(ClockLeap, OfASecondIsSeenInFineRows) {
  const Recording r = recorded(CommandLaw::free, 1.0, 900.0);
  EXPECT_EQ(leaps_of(leapt(r, 1300, 1.0)).size(), 1u);
  EXPECT_TRUE(leaps_of(without_rows(r, 1300, 1)).empty());
}

TEST(ClockLeap, NothingIsToldWhereThePlatformStandsOrNothingIsWrong) {
  EXPECT_TRUE(leaps_of(recorded(CommandLaw::free, 60.0, 3600.0)).empty());
  // A level platform drifts by what its gyros do: not in a row or two as seen through 5 arcsec.
  const Recording level = recorded(CommandLaw::level, 60.0, 1800.0);
  EXPECT_TRUE(leaps_of(level).empty());
  // Between positions time may pass.
  EXPECT_TRUE(leaps_of(leapt(recorded(CommandLaw::free, 60.0, 1800.0), 60, 3600.0)).empty());
}

TEST(ClockLeap, IsSaidFirstAndIsNoGap) {
  const Recording r = leapt(recorded(CommandLaw::free, 60.0, 3600.0), 90, 3600.0);
  const QualityCard card = quality_card(r, RecordingKind::platform);
  EXPECT_TRUE(card.gaps.empty());
  EXPECT_EQ(card.lost, 0.0);
  ASSERT_FALSE(card.remarks.texts().empty());
  EXPECT_EQ(card.remarks.texts().front().find("the clock leapt by 3600 s between lines"), 0u)
      << card.remarks.texts().front();
}

TEST(ClockLeap, IsRefusedWithWhatToSubtract) {
  PlanDefaults defaults;
  defaults.dwell = 3600.0;
  defaults.mode = CommandLaw::free;
  const mc::Study study = test::six_study(defaults);
  const Recording r = leapt(test::simulated(study), 90, 3600.0);
  try {
    preparation::prepare(study, {r});
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("Subtract 3600 s from every time from line"),
              std::string::npos)
        << e.what();
  }
}

}  // namespace
}  // namespace drift::clock_leap_test
