#include "core/plan/shifted_numbers.hpp"

#include <gtest/gtest.h>

#include "analysis/preparation/prepare.hpp"
#include "core/base/check.hpp"
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
      said.find(
          "the last rows of 5 positions, up to 3, show the platform in the next or on the way"),
      std::string::npos)
      << said;
  EXPECT_EQ(shifted_numbers(spikes, study.plan), "");
}

}  // namespace
}  // namespace drift::shifted_numbers_test
