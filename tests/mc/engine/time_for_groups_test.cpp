#include "mc/engine/time_for_groups.hpp"

#include <gtest/gtest.h>

#include "tests/support/program.hpp"
#include "tests/support/synthetic_study.hpp"

namespace drift::time_for_groups_test {
namespace {

TEST(TimeForGroups, NoneIsBegunThatWouldNotEndInTime) {
  mc::TimeForGroups time(12.0);
  time.begin();
  EXPECT_FALSE(time.is_over(11.9)) << "how long one takes is not known yet";
  time.end(4.0);
  time.end(3.0);
  EXPECT_EQ(time.longest(), 4.0);
  EXPECT_FALSE(time.is_over(7.5));
  EXPECT_TRUE(time.is_over(8.0));
}

TEST(TimeForGroups, OneIsBegunHoweverShortTheTime) {
  mc::TimeForGroups time(1.0);
  EXPECT_FALSE(time.is_over(5.0));
  time.begin();
  EXPECT_TRUE(time.is_over(5.0));
}

TEST(TimeForGroups, WithoutALimitThereIsTime) {
  mc::TimeForGroups time({});
  time.begin();
  time.end(1e9);
  EXPECT_FALSE(time.is_over(1e9));
}

/// Groups of 0.2 s and a wall in the middle of the third.
TEST(TimeForGroups, ASessionEndsBeforeItsWall) {
  const test::ScratchFolder folder;
  test::SyntheticStudy study{.task = {.milliseconds = 25.0, .together = 8}};
  study.options.threads = 1;
  study.options.max_wall = 0.5;
  const auto outcome = study.run(folder.path());
  EXPECT_EQ(outcome.code, ExitCode::wall_time);
  EXPECT_GE(outcome.kept, 8u);
  EXPECT_LE(outcome.kept, 16u);
}

TEST(TimeForGroups, APartThatIsCompleteIsNoSessionThatWasCutShort) {
  const test::ScratchFolder folder;
  test::SyntheticStudy study{.task = {.together = 8}, .options = {.runs = 16}, .block_size = 8};
  study.options.threads = 1;
  study.options.share = {0, 2};
  study.options.max_wall = 1e-6;  // no time for a second group, and this part has none
  const auto outcome = study.run(folder.path());
  EXPECT_EQ(outcome.code, ExitCode::ok);
  EXPECT_EQ(outcome.done, 8u);
  EXPECT_FALSE(outcome.complete);
}

}  // namespace
}  // namespace drift::time_for_groups_test
