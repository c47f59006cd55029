// A recording without a column of positions: what was taken away must come back.
#include "core/recording/rows/count_positions.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/check.hpp"
#include "core/sim/simulate.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::count_positions_test {
namespace {

using namespace drift::test;

TestPlan plan_of(std::string_view preset, CommandLaw law = CommandLaw::free,
                 double dwell = 1200.0) {
  PlanDefaults defaults;
  defaults.mode = law;
  defaults.dwell = dwell;
  defaults.sample = 60.0;
  return preset_plan(preset, defaults).value();
}

Recording recorded(const TestPlan& plan) {
  const TruthSpec truth = base_truth(Coupling::eq5);
  const Timeline timeline = lay_out(plan, harbin);
  const TruthDraw draw = draw_truth(truth, timeline.chains, 7, 3);
  const Readout readout;
  Recording r = make_recording(
      timeline, Simulator(truth, readout).run(timeline, draw, 7, 3).measured, readout);
  r.lines.resize(r.rows());
  for (std::size_t k = 0; k < r.rows(); ++k) r.lines[k] = k + 2;
  return r;
}

Recording without(Recording r, std::initializer_list<std::string_view> starts) {
  std::erase_if(r.channels, [&](const Channel& c) {
    return std::ranges::any_of(starts, [&](std::string_view s) { return c.name.starts_with(s); });
  });
  return r;
}

std::vector<double> values(const Recording& r, std::string_view name) {
  const Channel* c = r.find(name);
  return c == nullptr ? std::vector<double>(r.rows(), 0.0) : c->values;
}

/// As the fact says.
double counted(const Recording& r) {
  for (const auto& [key, value] : r.facts)
    if (key == positions_counted) return std::stod(value);
  return 0.0;
}

/// Rows put in before row `at`, on the way from the one before it: gimbals as `part` of it says,
/// the rest as it was.
void turn_by_hand(Recording& r, std::size_t at, int rows) {
  for (Channel& c : r.channels) {
    const double from = c.values[at - 1], to = c.values[at];
    for (int k = 1; k <= rows; ++k) {
      const double part = static_cast<double>(k) / (rows + 1.0);
      const bool turns = c.name.starts_with("gimbal_") || c.name == "case_heading";
      c.values.insert(c.values.begin() + static_cast<std::ptrdiff_t>(at) + k - 1,
                      c.name == "time" || turns ? from + part * (to - from) : from);
    }
  }
  r.lines.resize(r.rows());
  for (std::size_t k = 0; k < r.rows(); ++k) r.lines[k] = k + 2;
}

TEST(CountPositions, WhatWasTakenAwayComesBack) {
  for (const std::string_view preset :
       {"six", "twelve", "twentyfour", "apollo10", "slew12", "casespin"})
    for (const CommandLaw law : {CommandLaw::free, CommandLaw::level}) {
      const Recording whole = recorded(plan_of(preset, law));
      for (const auto lost :
           {std::initializer_list<std::string_view>{"position", "phase"},
            std::initializer_list<std::string_view>{"position", "phase", "acc_"}}) {
        Recording r = without(whole, lost);
        ASSERT_EQ(count_positions(r), "") << preset;
        EXPECT_EQ(values(r, "position"), values(whole, "position")) << preset;
        EXPECT_EQ(values(r, "phase"), values(whole, "phase")) << preset;
        EXPECT_EQ(counted(r), values(whole, "position").back()) << preset;
        ASSERT_EQ(r.remarks.texts().size(), 1u);
        EXPECT_NE(r.remarks.texts()[0].find("no column tells the positions"), std::string::npos);
      }
    }
}

TEST(CountPositions, AReadingThatIsNoneIsNoTurn) {
  const Recording whole = recorded(plan_of("six"));
  Recording r = without(whole, {"position", "phase"});
  for (Channel& c : r.channels)
    if (c.name == "gimbal_outer") c.values[30] += 0.5;
  EXPECT_EQ(count_positions(r), "");
  EXPECT_EQ(values(r, "position"), values(whole, "position"));
}

TEST(CountPositions, RowsInWhichItIsTurnedByHandAreLeftOut) {
  // A logger that runs on; the case may be turned, too, and the turn may be slow against a row.
  for (const auto& [preset, rows] : {std::pair{"six", 3}, {"twentyfour", 3}, {"six", 60}}) {
    const Recording whole = recorded(plan_of(preset));
    Recording r = without(whole, {"position", "phase"});
    for (std::size_t at = whole.rows() - 20; at > 0; at -= 20) turn_by_hand(r, at, rows);
    ASSERT_EQ(count_positions(r), "") << preset;
    EXPECT_EQ(values(r, "position"), values(whole, "position")) << preset;
    EXPECT_EQ(values(r, "phase"), values(whole, "phase")) << preset;
    // Where it arrives the gimbals are read, and the mean over the row is of the turn.
    EXPECT_EQ(values(r, "gimbal_outer"), values(whole, "gimbal_outer"));
    EXPECT_TRUE(std::isnan(values(r, "acc_x")[20]));
    EXPECT_EQ(values(r, "acc_x")[21], values(whole, "acc_x")[21]);
    EXPECT_EQ(r.lines[20], 20u + static_cast<std::size_t>(rows) + 2u) << "those of the file";
  }
}

TEST(CountPositions, ALogMayBeginOnTheWayAndBeSilentThere) {
  const Recording whole = recorded(plan_of("six"));
  Recording r = without(whole, {"position", "phase"});
  turn_by_hand(r, 20, 5);
  for (Channel& c : r.channels) {
    if (c.name.starts_with("gimbal_") || c.name.starts_with("acc_"))
      for (std::size_t k = 20; k < 25; ++k) c.values[k] = std::nan("");
    c.values.erase(c.values.begin(), c.values.begin() + 18);  // two rows of the first position
  }
  r.lines.erase(r.lines.begin(), r.lines.begin() + 18);
  ASSERT_EQ(count_positions(r), "");
  EXPECT_EQ(counted(r), 5.0);
  EXPECT_EQ(r.rows(), whole.rows() - 20);
  EXPECT_EQ(values(r, "position").front(), 1.0);
}

TEST(CountPositions, WhatCannotBeCountedIsLeftAlone) {
  Recording r = without(recorded(plan_of("six", CommandLaw::free, 180.0)), {"position", "phase"});
  const std::size_t columns = r.channels.size();
  EXPECT_NE(count_positions(r).find("stands for 3 rows alone"), std::string::npos);
  EXPECT_EQ(r.channels.size(), columns);
  r = without(recorded(plan_of("six")), {"position", "phase", "acc_", "gimbal_"});
  EXPECT_NE(count_positions(r).find("neither all gimbals"), std::string::npos);
  // The case turns below the platform, 10 deg a row, for longer than it stood.
  r = without(recorded(plan_of("six", CommandLaw::free, 3600.0)), {"position", "phase"});
  for (Channel& c : r.channels)
    for (std::size_t k = 10; k < 60; ++k) {
      const double turn =
          10.0 * drift::detail::deg * static_cast<double>(std::min<std::size_t>(k - 9, 30));
      if (c.name == "case_heading") c.values[k] += turn;
      if (c.name == "gimbal_inner") c.values[k] -= turn;
    }
  EXPECT_NE(count_positions(r).find("from line 12 on the case turns in 30 rows"), std::string::npos)
      << count_positions(r);
}

TEST(CountPositions, OtherThanThoseOfThePlanAreRefused) {
  const TestPlan six = plan_of("six");
  Recording r = without(recorded(six), {"position", "phase"});
  ASSERT_EQ(count_positions(r), "");
  EXPECT_NO_THROW(lay_out(r, six, harbin));
  TestPlan five = six;
  five.positions.pop_back();
  try {
    lay_out(r, five, harbin);
    FAIL() << "not refused";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("6 are counted"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace drift::count_positions_test
