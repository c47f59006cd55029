// The short answer of `rank`.
#include <gtest/gtest.h>

#include "analysis/report/rank/sections.hpp"

namespace drift::rank_brief_test {
namespace {

using namespace report;

struct Answer {
  mc::Study study;
  planning::PlanRanking rank;
  InBrief brief;

  explicit Answer(const std::string& text, const planning::RankOptions& options = {.threads = 1})
      : study(mc::read_study_text(text, "s.toml")),
        rank(planning::rank_plan(study, options)),
        brief(rank_in_brief(study, rank)) {}
};

bool has(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

TEST(RankBrief, SaysForWhichFilterAndEquationAPlanIsBetter) {
  const Answer a(R"(schema = 1
[site]
latitude = "45.75 deg"
[plan]
dwell  = "10 min"
sample = "2 min"
mode   = "level"
[[plan.position]]
axes  = "x=N y=W z=U"
[[filter]]
name = "corrected"
coupling = "eq6"
terms = ["fixed_drift"]
[[filter]]
name = "legacy"
coupling = "eq5"
terms = ["fixed_drift"]
)",
                 {.improve = 1, .criterion = "D_F_z", .threads = 1});
  EXPECT_TRUE(has(a.brief.verdict, "Seen under eq6 (filter corrected): ")) << a.brief.verdict;
  const std::string better = a.brief.more.texts().front();
  EXPECT_TRUE(has(better, "under eq6 (filter corrected)")) << better;
}

}  // namespace
}  // namespace drift::rank_brief_test
