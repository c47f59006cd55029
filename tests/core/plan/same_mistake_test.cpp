// The same mistake in many rows of a recording is one message with a count.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/base/check.hpp"
#include "core/plan/timeline.hpp"
#include "tests/support/six_positions.hpp"

namespace drift::same_mistake_test {
namespace {

std::vector<std::string> refusal(const Recording& r) {
  const mc::Study s = test::six_study();
  try {
    lay_out(r, s.plan, s.site);
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), ExitCode::recording);
    return error.messages();
  }
  return {};
}

TEST(SameMistake, AnEmptyColumnOfHeadingsIsOneMessage) {
  Recording r = test::simulated(test::six_study());
  std::ranges::fill(test::channel(r, "case_heading"), std::numeric_limits<double>::quiet_NaN());
  const auto said = refusal(r);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said.front(),
            "recording:1: case_heading is missing (expected a number in every row). Give it, or "
            "leave the column out (119 more of the kind, the last in line 120)");
}

TEST(SameMistake, AnotherMistakeIsAnotherMessage) {
  Recording r = test::simulated(test::six_study());
  for (const std::size_t row : {3u, 7u})
    for (const char* name : {"case_heading", "cmd_y"})
      test::channel(r, name)[row] = std::numeric_limits<double>::quiet_NaN();
  const auto said = refusal(r);
  ASSERT_EQ(said.size(), 2u);
  EXPECT_TRUE(said[0].starts_with("recording:4: cmd_x, cmd_y, cmd_z: not all")) << said[0];
  EXPECT_TRUE(said[1].starts_with("recording:4: case_heading is missing")) << said[1];
  for (const std::string& text : said)
    EXPECT_TRUE(text.ends_with(" (1 more of the kind, the last in line 8)")) << text;
}

TEST(SameMistake, OneRowIsNotCounted) {
  Recording r = test::simulated(test::six_study());
  test::channel(r, "case_heading")[5] = std::numeric_limits<double>::quiet_NaN();
  const auto said = refusal(r);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_TRUE(said.front().ends_with("leave the column out")) << said.front();
}

}  // namespace
}  // namespace drift::same_mistake_test
