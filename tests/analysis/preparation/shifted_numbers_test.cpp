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

}  // namespace
}  // namespace drift::shifted_numbers_test
