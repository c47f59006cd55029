#include "analysis/preparation/clock_unit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "analysis/preparation/prepare.hpp"
#include "core/base/check.hpp"
#include "tests/support/six_positions.hpp"

namespace drift::preparation::clock_unit_test {
namespace {

mc::Study study(CommandLaw law = CommandLaw::free) {
  PlanDefaults defaults;
  defaults.dwell = 1200.0;
  defaults.mode = law;
  return test::six_study(defaults);
}

Recording with_times(Recording r, double factor) {
  for (Channel& c : r.channels)
    for (double& value : c.values)
      if (c.name == "time") value *= factor;
  return r;
}

bool says(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

TEST(ClockUnit, TimesInAnotherUnitAreRefusedWithTheUnitThatTheyAreIn) {
  const mc::Study s = study();
  const Recording r = test::simulated(s);
  EXPECT_EQ(other_unit_of_time(r), "");
  for (const auto& [factor, units] : {std::pair{1.0 / 60.0, "Are they in min where s is said?"},
                                      {1e-3, "Are they in s where ms is said?"},
                                      {1.0 / 3600.0, "Are they in h where s is said?"},
                                      {60.0, "Are they in s where min is said?"},
                                      {1000.0, "Are they in ms where s is said?"},
                                      {3600.0, "Are they in s where h is said?"}})
    EXPECT_TRUE(says(other_unit_of_time(with_times(r, factor)), units))
        << factor << other_unit_of_time(with_times(r, factor));
  try {
    prepare(s, {with_times(r, 1.0 / 60.0)});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), ExitCode::recording);
    EXPECT_TRUE(says(error.what(), "Are they in min where s is said?")) << error.what();
  }
}

TEST(ClockUnit, AClockThatIsOffByLessIsNoOtherUnit) {
  const Recording r = test::simulated(study());
  for (const double factor : {0.25, 0.9, 1.1, 4.0})
    EXPECT_EQ(other_unit_of_time(with_times(r, factor)), "") << factor;
  // So many times as fast as the Earth nothing turns, whatever the unit.
  EXPECT_TRUE(says(other_unit_of_time(with_times(r, 1.0 / 200.0)), "expected about 15 deg/h"));
}

TEST(ClockUnit, LabelsThatComeLateAreNoOtherUnit) {
  const Recording r = test::simulated(study());
  for (const std::size_t late : {2, 3, 5}) {
    Recording wrong = r;
    for (Channel& c : wrong.channels)
      if (c.name == "position") {
        c.values.insert(c.values.begin(), late, c.values.front());
        c.values.resize(r.rows());
      }
    EXPECT_EQ(other_unit_of_time(wrong), "") << late;
  }
}

/// Its first rows are on the way from the position before, turned by an operator.
TEST(ClockUnit, RowsOnTheWayUnderTheNextNumberAreNoOtherUnit) {
  const mc::Study s = study();
  Recording r = test::simulated(s);
  const std::vector<double> position = test::channel(r, "position");
  constexpr std::size_t way = 5;
  for (std::size_t first = 1; first + way < position.size(); ++first) {
    if (position[first] == position[first - 1]) continue;
    for (Channel& c : r.channels) {
      const bool angle = c.name.starts_with("gimbal_");
      if (!angle && !c.name.starts_with("acc_")) continue;
      const double from = c.values[first - 1];
      double turn = c.values[first + way] - from;
      if (angle) turn = std::remainder(turn, 2.0 * std::numbers::pi);
      for (std::size_t k = 0; k < way; ++k)
        c.values[first + k] =
            from + turn * static_cast<double>(k + 1) / static_cast<double>(way + 1);
    }
  }
  EXPECT_EQ(other_unit_of_time(r), "");
  try {
    prepare(s, {r});
    FAIL() << "read";
  } catch (const InputError& error) {
    EXPECT_TRUE(says(error.what(), "the first rows of 5 positions, up to 5")) << error.what();
  }
}

TEST(ClockUnit, OfAPlatformThatIsKeptLevelNothingIsSaid) {
  Recording r = test::simulated(study(CommandLaw::level));
  for (const double factor : {1.0 / 60.0, 1.0, 60.0})
    EXPECT_EQ(other_unit_of_time(with_times(r, factor)), "") << factor;
  // Without recorded commands it may be level: that it turns slowly says nothing.
  std::erase_if(r.channels, [](const Channel& c) { return c.name.starts_with("cmd_"); });
  for (const double factor : {1.0, 60.0})
    EXPECT_EQ(other_unit_of_time(with_times(r, factor)), "") << factor;
}

TEST(ClockUnit, OneInstrumentAloneMayBeInAnotherUnitItself) {
  for (const double factor : {1.0, 1.0 / 60.0})
    for (const char* instrument : {"gimbal_", "acc_"}) {
      Recording r = with_times(test::simulated(study()), factor);
      std::erase_if(r.channels, [&](const Channel& c) { return c.name.starts_with(instrument); });
      EXPECT_EQ(other_unit_of_time(r), "");
    }
  for (const double angle : {180.0 / std::numbers::pi, std::numbers::pi / 180.0}) {
    Recording r = test::simulated(study());
    for (Channel& c : r.channels)
      for (double& value : c.values)
        if (c.name.starts_with("gimbal_")) value *= angle;
    EXPECT_EQ(other_unit_of_time(r), "") << angle;
  }
}

}  // namespace
}  // namespace drift::preparation::clock_unit_test
