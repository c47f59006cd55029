// What proposed positions bring, in the report of `rank`.
#include <gtest/gtest.h>

#include "analysis/report/rank/sections.hpp"
#include "tests/analysis/report/figures_of.hpp"

namespace drift::rank_improvement_test {
namespace {

TEST(RankImprovement, SaysOfOneParameterThatItGainsLess) {
  // Without accelerometers nothing shows K0_x; a further position shows more of each drift.
  const mc::Study study = mc::read_study_text(R"(schema = 1
[site]
latitude = "45.75 deg"
[plan]
dwell  = "10 min"
sample = "5 min"
mode   = "level"
[[plan.position]]
axes = "x=N y=W z=U"
[readout]
accelerometers = false
[[filter]]
name = "f"
coupling = "eq5"
terms = ["D_F", "K0_x"]
)",
                                              "s.toml");
  const planning::PlanRanking rank = planning::rank_plan(study, {.improve = 1, .threads = 1});
  const auto figures = test::figures_of({report::improvement(study, rank)});
  ASSERT_EQ(figures.size(), 1u);
  EXPECT_NE(figures[0].caption.find(" 1 parameter gains less, or nothing: it is in the table."),
            std::string::npos)
      << figures[0].caption;
}

}  // namespace
}  // namespace drift::rank_improvement_test
