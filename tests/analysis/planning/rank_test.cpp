// What of a study is ranked, and for whom positions are proposed.
#include "analysis/planning/rank.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace drift::rank_test {
namespace {

constexpr const char* torqued_twice = R"(schema = 1
[site]
latitude = "45.75 deg"
[plan]
dwell  = "10 min"
sample = "2 min"
mode   = "free"
entry  = "torqued"
[[plan.position]]
axes  = "x=N y=W z=U"
entry = "caged"
[[plan.position]]
axes = "x=N y=U z=E"
[truth]
coupling = "eq5"
terms = ["fixed_drift", "gyro_misalignment"]
[truth.parameters]
D_F = "1 deg/h"
)";

std::string filter(const std::string& name, const std::string& coupling) {
  return "[[filter]]\nname = \"" + name + "\"\ncoupling = \"" + coupling +
         "\"\nterms = [\"fixed_drift\", \"gyro_misalignment\"]\n";
}

TEST(RankPlan, ChoosesPositionsForTheFirstFilterWhicheverItsEquation) {
  for (const Coupling first : {Coupling::eq5, Coupling::eq6}) {
    const bool swapped = first == Coupling::eq6;
    const mc::Study study =
        mc::read_study_text(torqued_twice + filter("one", swapped ? "eq6" : "eq5") +
                                filter("other", swapped ? "eq5" : "eq6"),
                            "s.toml");
    const planning::PlanRanking rank = planning::rank_plan(
        study, {.improve = 1, .criterion = "eta_x", .threads = 1, .bins_per_dwell = 1});
    ASSERT_EQ(rank.groups.size(), 1u);
    const planning::ModelRanking& m = rank.groups.front().models.front();
    EXPECT_EQ(m.model.spec.coupling, first);
    EXPECT_EQ(m.filters, "one");
    const planning::Improvement& better = rank.better->improvement;
    ASSERT_EQ(better.steps.size(), 1u);
    // The criterion is the learning ratio of eta_x by the information of the same model: rounding.
    const double ratio = m.ranking.learning_ratio(better.criterion.state);
    EXPECT_NEAR(better.steps.front().before, ratio, 1e-9 * ratio);
    // Under the other equation eta_x is another sigma, or the two could not be told apart here.
    const double other =
        rank.groups.front().models[1].ranking.learning_ratio(better.criterion.state);
    EXPECT_GT(std::abs(other - ratio), 1e-3 * ratio);
  }
}

}  // namespace
}  // namespace drift::rank_test
