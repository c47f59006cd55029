#include "core/plan/shifted_numbers.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "analysis/preparation/prepare.hpp"
#include "core/base/check.hpp"
#include "core/recording/recording_channels.hpp"
#include "tests/support/six_positions.hpp"

namespace drift::shifted_numbers_test {
namespace {

/// The numbers of the positions so many rows later, or earlier.
Recording shifted(Recording r, std::ptrdiff_t rows) {
  for (Channel& c : r.channels)
    if (c.name == "position") {
      const std::vector<double> was = c.values;
      const auto last = static_cast<std::ptrdiff_t>(was.size()) - 1;
      for (std::ptrdiff_t k = 0; k <= last; ++k)
        c.values[static_cast<std::size_t>(k)] =
            was[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(k - rows, 0, last))];
    }
  return r;
}

TEST(ShiftedNumbers, AreToldWithTheRowsByWhichTheyAreOff) {
  const mc::Study study = test::six_study();
  const Recording right = test::simulated(study);
  EXPECT_EQ(shifted_numbers(right, study.plan), "");
  for (const std::ptrdiff_t rows : {2, 3, 5}) {
    const std::string late = shifted_numbers(shifted(right, rows), study.plan),
                      early = shifted_numbers(shifted(right, -rows), study.plan);
    EXPECT_NE(late.find(fmt::format("the last {} rows of 5 positions", rows)), std::string::npos)
        << late;
    EXPECT_NE(late.find("Let them change so many rows earlier"), std::string::npos) << late;
    EXPECT_NE(early.find(fmt::format("the first {} rows of 5 positions", rows)), std::string::npos)
        << early;
    EXPECT_NE(early.find("Let them change so many rows later"), std::string::npos) << early;
    EXPECT_THROW(preparation::prepare(study, {shifted(right, rows)}), InputError);
  }
}

/// One row is said by what it does; a platform that is turned within a position is not of another.
TEST(ShiftedNumbers, OneRowOrTurnsInTheMiddleAreNone) {
  const mc::Study study = test::six_study();
  const Recording right = test::simulated(study);
  EXPECT_EQ(shifted_numbers(shifted(right, 1), study.plan), "");
  EXPECT_EQ(shifted_numbers(shifted(right, -1), study.plan), "");
  EXPECT_EQ(shifted_numbers(shifted(right, 10), study.plan), "");
  mc::Study slewed = study;
  for (Position& p : slewed.plan.positions) p.entry = Entry::torqued;
  EXPECT_EQ(shifted_numbers(shifted(right, 3), slewed.plan), "");
}

/// The number of one position alone comes late: the platform jumps before it, and not with it.
TEST(ShiftedNumbers, OneNumberThatIsLateIsTold) {
  const mc::Study study = test::six_study();
  Recording late = test::simulated(study), turned = late;
  std::vector<double>& position = test::channel(late, "position");
  for (std::size_t k = position.size() - 1; k > 1; --k)
    if (position[k] == 3.0 && position[k - 2] == 2.0) position[k] = 2.0;
  const std::string said = shifted_numbers(late, study.plan);
  EXPECT_NE(said.find("the last rows of 1 position, up to 2, show the platform in the next"),
            std::string::npos)
      << said;
  // One that is turned in the end of a position and caged anew behind it may be right.
  const std::vector<double>& number = test::channel(turned, "position");
  for (std::size_t k = 2; k < number.size(); ++k)
    if (number[k] == 2.0 && number[k - 1] == 1.0)
      for (const std::size_t row : {k - 2, k - 1})
        test::channel(turned, "gimbal_outer")[row] += 0.7;
  EXPECT_EQ(shifted_numbers(turned, study.plan), "");
}

/// Rows on the way behind the numbers of where it begins; a reading that is none turns nothing.
TEST(ShiftedNumbers, RowsOnTheWayAtTheEndOfPositionsAreToldAsThat) {
  const mc::Study study = test::six_study();
  Recording turned = test::simulated(study), spikes = turned;
  const std::vector<double> position = turned.find("position")->values;
  const auto& time = turned.find("time")->values;
  std::size_t changes = 0;
  for (std::size_t k = 0; k + 1 < time.size(); ++k) {
    if (position[k] == position[k + 1]) continue;
    ++changes;
    for (std::size_t back = 0; back < 2 + changes % 2; ++back)
      test::channel(turned, "gimbal_outer")[k - back] += 0.7 - 0.2 * static_cast<double>(back);
    test::channel(spikes, "gimbal_outer")[k - 1 - changes % 2] += 0.7;
  }
  const std::string said = shifted_numbers(turned, study.plan);
  EXPECT_NE(
      said.find("the last rows of 5 positions, up to 3 (lines 18 to 20), show the platform in "
                "the next or on the way"),
      std::string::npos)
      << said;
  EXPECT_EQ(shifted_numbers(spikes, study.plan), "");
}

/// Columns so many rows later in the file, or earlier, against all others.
Recording moved(Recording r, const ChannelTriple& channels, std::ptrdiff_t rows) {
  for (const std::string_view name : channels.names) {
    std::vector<double>& values = test::channel(r, name);
    const std::vector<double> was = values;
    const auto last = static_cast<std::ptrdiff_t>(was.size()) - 1;
    for (std::ptrdiff_t k = 0; k <= last; ++k)
      values[static_cast<std::size_t>(k)] =
          was[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(k - rows, 0, last))];
  }
  return r;
}

void expect_part(const std::string& said, const std::string& part) {
  EXPECT_NE(said.find(part), std::string::npos) << part << "\n" << said;
}

/// The case turns with some of the numbers, whatever the gimbals show there.
TEST(ColumnsRowsOff, AreToldByTheInstrumentThatTurnsWithTheNumbers) {
  const mc::Study study = test::six_study(1200.0, 10.0);
  const Recording right = test::simulated(study);
  for (const std::ptrdiff_t rows : {2, 9, -3}) {
    const std::string way = rows > 0 ? "late" : "early", move = rows > 0 ? "up" : "down";
    for (const bool acc : {false, true}) {
      const ChannelTriple& off = acc ? accelerometer_channels : gimbal_channels;
      const Recording wrong = moved(right, off, rows);
      const std::string said = shifted_numbers(wrong, study.plan);
      expect_part(said, fmt::format("columns {}, {}, {} stand {} rows {}. Move them {} rows {}",
                                    off.names[0], off.names[1], off.names[2], std::abs(rows), way,
                                    std::abs(rows), move));
      expect_part(said, "in 5 of them");
      EXPECT_EQ(said.find("numbers of the positions change"), std::string::npos) << said;
      EXPECT_EQ(said, shifted_numbers(wrong)) << "what look says, without a plan";
      EXPECT_EQ(shifted_numbers(moved(wrong, off, -rows), study.plan), "") << "the advice";
    }
  }
  // Numbers that change so much earlier, and the gimbals beside the accelerometers.
  const std::string neither =
      shifted_numbers(shifted(moved(right, gimbal_channels, 5), 2), study.plan);
  expect_part(neither, "nothing tells which of them turn with the number");
}

/// Twenty rows of a turn, so many of them before the number changes.
Recording turning(Recording r, std::size_t before) {
  constexpr std::size_t way = 20;
  const std::vector<double> position = r.find("position")->values;
  for (std::size_t at = 1; at < position.size(); ++at) {
    if (position[at] == position[at - 1]) continue;
    const std::size_t from = at - before - 1;
    for (const ChannelTriple& channels : {accelerometer_channels, gimbal_channels})
      for (const std::string_view name : channels.names) {
        std::vector<double>& x = test::channel(r, name);
        const double begin = x[from], turn = x[from + way + 1] - begin;
        const bool angle = channels.names == gimbal_channels.names;
        for (std::size_t k = 1; k <= way; ++k)
          x[from + k] = begin + (angle ? std::remainder(turn, 2.0 * std::numbers::pi) : turn) *
                                    static_cast<double>(k) / static_cast<double>(way + 1);
      }
  }
  return r;
}

/// 90 deg in twenty rows: none of them jumps by as much as a plan may be missed.
TEST(TurnsInPositions, AreToldWithTheRowsThatTheyTake) {
  const mc::Study study = test::six_study(1200.0, 10.0);
  const Recording right = test::simulated(study);
  const std::string last = "the last rows of 5 positions, up to ",
                    first = "the first rows of 5 positions, up to ";
  for (const std::size_t before : {0u, 5u, 20u}) {
    const Recording wrong = turning(right, before);
    const std::string said = shifted_numbers(wrong, study.plan);
    if (before > 0) expect_part(said, last + std::to_string(before) + " (lines");
    if (before < 20) expect_part(said, first + std::to_string(20 - before) + " (lines");
    EXPECT_EQ(said.find("last rows") != std::string::npos, before > 0) << said;
    EXPECT_EQ(said.find("first rows") != std::string::npos, before < 20) << said;
    expect_part(said, "[recording] ignore = [\"position\"]");
    EXPECT_EQ(said, shifted_numbers(wrong));
    EXPECT_THROW(preparation::prepare(study, {wrong}), InputError);
  }
}

TEST(TurnsInPositions, AreToldWithTheHeaderThatTheColumnHas) {
  mc::Study study = test::six_study(1200.0, 10.0);
  study.recording.columns.push_back({"position", "Label", std::nullopt});
  try {
    preparation::prepare(study, {turning(test::simulated(study), 20)});
    FAIL() << "read";
  } catch (const InputError& error) {
    expect_part(error.what(), "ignore = [\"Label\"]");
  }
}

/// Plans of every kind, with coarse gimbals, too.
TEST(ShiftedNumbers, NothingIsSaidOfRowsThatAreRight) {
  for (const std::string_view preset : preset_names)
    for (const Entry entry : {Entry::caged, Entry::torqued}) {
      PlanDefaults defaults;
      defaults.dwell = 1200.0;
      defaults.sample = 20.0;
      defaults.entry = entry;
      mc::Study study = test::six_study();
      study.plan = preset_plan(preset, defaults).value();
      Recording r = test::simulated(study);
      for (const double step : {0.0, 0.05, 0.5}) {
        for (const std::string_view name : gimbal_channels.names)
          if (step > 0.0)
            for (double& x : test::channel(r, name))
              x = std::round(x / (step * detail::deg)) * step * detail::deg;
        EXPECT_EQ(shifted_numbers(r, study.plan), "") << preset << " " << step;
        EXPECT_EQ(shifted_numbers(r), "") << preset << " " << step;
      }
    }
}

}  // namespace
}  // namespace drift::shifted_numbers_test
