// One recording that was cut within a position and given as two.
#include <gtest/gtest.h>

#include "analysis/preparation/prepare.hpp"
#include "tests/support/six_positions.hpp"

namespace drift::preparation::parts_of_one_test {
namespace {

/// Rows `from` to `to` of a recording.
Recording part_of(Recording r, const char* source, std::size_t from, std::size_t to) {
  const auto cut = [&](auto& values) {
    values = {values.begin() + static_cast<std::ptrdiff_t>(from),
              values.begin() + static_cast<std::ptrdiff_t>(to)};
  };
  for (Channel& c : r.channels) cut(c.values);
  cut(r.lines);
  r.source = source;
  return r;
}

struct PartsOfOne : testing::Test {
  mc::Study study = test::six_study();  // 20 rows of each position
  Recording whole = test::simulated(study);

  bool says_so(const std::vector<Recording>& recordings) const {
    return test::says(prepare(study, recordings),
                      "second.csv: begins in position 4, 60 s after first.csv ends there: parts of "
                      "one recording?");
  }
};

TEST_F(PartsOfOne, ACutWithinAPositionIsSaidWhateverTheOrder) {
  const Recording first = part_of(whole, "first.csv", 0, 70),
                  second = part_of(whole, "second.csv", 70, 120);
  EXPECT_TRUE(says_so({first, second}));
  EXPECT_TRUE(says_so({second, first}));
  EXPECT_TRUE(
      test::says(prepare(study, {first, second}),
                 "join them into one file, the rows of second.csv below those of first.csv"));
}

TEST_F(PartsOfOne, WhatBeginsInAnotherPositionOrLaterIsNoPart) {
  const Recording first = part_of(whole, "first.csv", 0, 70);
  EXPECT_FALSE(says_so({part_of(whole, "first.csv", 0, 60), part_of(whole, "second.csv", 60, 120)}))
      << "cut between positions";
  EXPECT_FALSE(says_so({first, part_of(whole, "second.csv", 74, 120)})) << "five samples later";
  Recording later = part_of(whole, "second.csv", 70, 120);
  for (double& t : test::channel(later, "time")) t += 86400.0;
  EXPECT_FALSE(says_so({first, later})) << "the next day";
  EXPECT_FALSE(says_so({whole, whole}));
}

}  // namespace
}  // namespace drift::preparation::parts_of_one_test
