// Rows of several recordings are held against the plan as those of one are.
#include <gtest/gtest.h>

#include "analysis/preparation/prepare.hpp"
#include "core/base/check.hpp"
#include "tests/support/six_positions.hpp"

namespace drift::preparation::several_intervals_test {
namespace {

Recording named(Recording r, const char* source) {
  r.source = source;
  return r;
}

Recording every_other_row(const Recording& r) {
  Recording out;
  for (const Channel& c : r.channels) {
    out.channels.push_back({c.name, c.unit, {}});
    for (std::size_t row = 1; row < r.rows(); row += 2)
      out.channels.back().values.push_back(c.values[row]);
  }
  return out;
}

std::string refusal(const mc::Study& s, const std::vector<Recording>& recordings) {
  try {
    prepare(s, recordings);
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), ExitCode::recording);
    return error.what();
  }
  return "";
}

TEST(SeveralIntervals, RowsThatDoNotFitThePlanAreRefusedBesideOthersAsAlone) {
  const mc::Study s = test::six_study();
  const Recording whole = named(test::simulated(s), "whole.csv"),
                  half = named(every_other_row(whole), "half.csv");
  const std::string alone = refusal(s, {half});
  EXPECT_NE(alone.find("half.csv: samples are 120 s apart, in the plan 60 s"), std::string::npos)
      << alone;
  EXPECT_EQ(refusal(s, {whole, half}), alone);
  EXPECT_EQ(refusal(s, {half, whole}), alone);
}

TEST(SeveralIntervals, AClockThatIsOffIsSaidOfTheFileWhoseItIs) {
  const mc::Study s = test::six_study();
  const Recording right = named(test::simulated(s), "right.csv");
  Recording slow = named(right, "slow.csv");
  for (double& t : test::channel(slow, "time")) t *= 1.002;
  const char* said = "slow.csv: samples are 60.12 s apart, in the plan 60 s: 0.2 % longer";
  EXPECT_TRUE(test::says(prepare(s, {slow}), said));
  for (const auto& both : {std::vector{right, slow}, std::vector{slow, right}}) {
    const Prepared p = prepare(s, both);
    EXPECT_TRUE(test::says(p, said));
    EXPECT_FALSE(test::says(p, "right.csv: samples are"));
  }
  const Prepared all = prepare(s, {slow, named(slow, "other.csv")});  // of one interval
  EXPECT_TRUE(test::says(all, said));
  EXPECT_TRUE(test::says(all, "other.csv: samples are 60.12 s apart"));
}

TEST(SeveralIntervals, FineRowsBesideThePlansAreNeitherRefusedNorSaid) {
  const mc::Study s = test::six_study();
  const Recording fine = named(test::simulated(test::six_study(1200.0, 30.0)), "fine.csv"),
                  planned = named(test::simulated(s), "planned.csv");
  const Prepared p = prepare(s, {planned, fine});
  EXPECT_FALSE(test::says(p, "samples are"));
  EXPECT_EQ(p.recordings[1].rows(), p.recordings[0].rows());
}

}  // namespace
}  // namespace drift::preparation::several_intervals_test
