// What a plan does not see, in the report of `rank`.
#include <gtest/gtest.h>

#include <algorithm>

#include "analysis/report/rank/sections.hpp"

namespace drift::rank_unseen_test {
namespace {

/// All that is said, on one line.
std::string said_of(const std::string& terms) {
  const mc::Study study = mc::read_study_text(R"(schema = 1
[site]
latitude = "45 deg"
[plan]
preset = "twentyfour"
dwell  = "10 min"
sample = "5 min"
mode   = "level"
[[filter]]
name = "f"
coupling = "eq5"
terms = )" + terms + "\n",
                                              "s.toml");
  std::string text =
      to_text(report::rank_report(study, planning::rank_plan(study, {.threads = 1})));
  std::ranges::replace(text, '\n', ' ');
  return text;
}

TEST(RankUnseen, HasNoTableOfDirectionsWhereAllAreSeen) {
  const std::string headings = "unrounded  direction";
  const std::string all = said_of("[\"K0\", \"K1\"]");
  EXPECT_NE(all.find("by eq. (5) or (6): none. Every direction leaves a signal."),
            std::string::npos)
      << all;
  EXPECT_EQ(all.find(headings), std::string::npos);
  // At cardinal positions a_I^3 = a_I.
  const std::string some = said_of("[\"K0\", \"K1\", \"K3\"]");
  EXPECT_EQ(some.find(": none."), std::string::npos);
  EXPECT_NE(some.find(headings), std::string::npos) << some;
}

}  // namespace
}  // namespace drift::rank_unseen_test
